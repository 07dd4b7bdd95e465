// SPDX-License-Identifier: MIT
//
// The only descriptor set: bindless arrays of sampled images, storage images and samplers, laid out
// as in spirv_interface.h. In rtapi, a Descriptor's address is an index into them. Index 0 of each
// array is never given out, so that it can mean "none".
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>

#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

// The values are the bindings in spirv_interface.h.
enum class BindlessArray : uint32_t { kSampledImages = 0, kStorageImages = 1, kSamplers = 2 };

class DescriptorSet {
 public:
  // Errors: KA0952.
  static rtapi::Result<std::shared_ptr<DescriptorSet>> create(std::shared_ptr<Gpu> gpu);
  ~DescriptorSet();
  DescriptorSet(const DescriptorSet&) = delete;
  DescriptorSet& operator=(const DescriptorSet&) = delete;

  VkDescriptorSetLayout layout() const { return layout_; }
  VkDescriptorSet handle() const { return set_; }
  uint32_t capacity(BindlessArray array) const {
    return arrays_[static_cast<uint32_t>(array)].size;
  }

  // Writes a descriptor to a free index, for images also that of the other form, or null, to the
  // next one. Images must be in layout GENERAL. Thread-safe. Errors: KA0956 when all indices are
  // taken.
  rtapi::Result<uint32_t> add_sampled_images(VkImageView view, VkImageView other_form);
  rtapi::Result<uint32_t> add_storage_images(VkImageView view, VkImageView other_form);
  rtapi::Result<uint32_t> add_sampler(VkSampler sampler);
  // Makes it, and an image's other form, a null descriptor if the device has those, so that
  // leftover uses of the index read zeros; the index is reused as late as possible. No running work
  // may use it.
  void remove(BindlessArray array, uint32_t index);

 private:
  struct Array {
    uint32_t size = 0;
    uint32_t each = 2;          // indices of one descriptor
    uint32_t next = 2;          // the lowest index never given out; none is 0
    std::deque<uint32_t> free;  // oldest first
  };
  explicit DescriptorSet(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)) {}
  rtapi::Status start();
  rtapi::Result<uint32_t> add(BindlessArray array, const VkDescriptorImageInfo& image,
                              VkImageView other_form);
  void write(BindlessArray array, uint32_t index, const VkDescriptorImageInfo& image);

  std::shared_ptr<Gpu> gpu_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  std::mutex mutex_;
  Array arrays_[3];
};

}  // namespace kaamos::vulkan
