// SPDX-License-Identifier: MIT
//
// A texture: a Vulkan image with its memory, always in layout GENERAL, and its views in the
// bindless set.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/backend/draw_commands.h"
#include "runtime/vulkan/textures/descriptor_set.h"

namespace kaamos::vulkan {

class Image final : public runtime::BackendTexture {
 public:
  // Filled with zeros, or with what lies at a place in a heap. Errors: KA0960 the device does not
  // support such textures, KA0990 out of memory.
  static rtapi::Result<std::shared_ptr<Image>> create(std::shared_ptr<Gpu> gpu,
                                                      std::shared_ptr<DescriptorSet> descriptors,
                                                      const rtapi::TextureDesc& desc,
                                                      const runtime::HeapPlace* place);
  // What such an image needs in a heap; 0 if it cannot lie in one.
  static uint64_t placed_bytes(const std::shared_ptr<Gpu>& gpu,
                               const std::shared_ptr<DescriptorSet>& descriptors,
                               const rtapi::TextureDesc& desc);
  ~Image() override;

  VkImage handle() const { return handle_; }
  VkImageType type() const { return type_; }
  const rtapi::TextureDesc& desc() const { return desc_; }
  // The bytes of a texel, or of a block of block_side() x block_side() texels.
  uint32_t element_bytes() const { return rtapi::GetFormatInfo(desc_.Format).bytes; }
  uint32_t block_side() const { return rtapi::GetFormatInfo(desc_.Format).block_side; }
  VkExtent3D extent(uint32_t mip) const;
  // Colour, or depth, or depth and stencil.
  VkImageAspectFlags aspects() const { return aspects_; }
  uint32_t array_size() const {
    return type_ == VK_IMAGE_TYPE_3D ? 1 : uint32_t{desc_.DepthOrArraySize};
  }

  // The view's index in the bindless set; equal descs share one. The same view as an array, or of
  // its first element alone, has the next index. Thread-safe. Errors: KA0961 the
  // device does not support such views, KA0956 too many views.
  rtapi::Result<uint64_t> view(const runtime::TextureViewDesc& desc);
  // The unordered access view with that index; none if it is not a view of this texture.
  std::optional<runtime::TextureViewDesc> storage_view(uint64_t index) const;
  // The view that a rendering draws to; equal targets share one. Thread-safe.
  rtapi::Result<VkImageView> target_view(const runtime::TargetView& target);

 private:
  struct View {
    runtime::TextureViewDesc desc;
    VkImageView view;
    VkImageView other_form;  // null if it has none
    uint32_t index;
  };
  struct DrawnView {
    VkFormat format;
    uint32_t mip;
    uint32_t first_slice;
    uint32_t slice_count;
    VkImageView view;
  };
  Image(std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors,
        const rtapi::TextureDesc& desc);
  VkImageCreateInfo create_info() const;
  rtapi::Status check_support(const VkImageCreateInfo& info) const;
  bool can_be_placed(const VkImageCreateInfo& info) const;
  rtapi::Status allocate(const VkImageCreateInfo& info);
  rtapi::Status import_pages(VkImageCreateInfo info, const runtime::HeapPlace& place);
  // From no layout to GENERAL.
  VkImageMemoryBarrier first_barrier() const;
  rtapi::Status enter_layout();
  rtapi::Status fill_with_zeros();
  void clear_blocks(VkCommandBuffer commands, const GpuBuffer& zeros) const;
  rtapi::Status check_view(const runtime::TextureViewDesc& desc) const;
  rtapi::Result<VkImageView> create_view(const runtime::TextureViewDesc& desc) const;
  rtapi::Result<VkImageView> create_other_form(const runtime::TextureViewDesc& desc) const;
  bool typeless() const;
  bool mutable_format() const;
  // "name" (size, format), for messages.
  std::string description() const;

  std::shared_ptr<Gpu> gpu_;
  std::shared_ptr<DescriptorSet> descriptors_;
  rtapi::TextureDesc desc_;
  VkImageType type_;
  VkImageAspectFlags aspects_;
  VkImage handle_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  runtime::MappedPages pages_;  // of a heap, from which the memory was imported
  mutable std::mutex mutex_;
  std::vector<View> views_;
  std::vector<DrawnView> drawn_views_;
};

}  // namespace kaamos::vulkan
