// SPDX-License-Identifier: MIT
#include "runtime/vulkan/textures/image.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/backend/errors.h"
#include "runtime/vulkan/textures/texture_format.h"

namespace kaamos::vulkan {
namespace {

VkImageType image_type(rtapi::ResourceDimension dimension) {
  switch (dimension) {
    case rtapi::ResourceDimension::kTexture1D:
      return VK_IMAGE_TYPE_1D;
    case rtapi::ResourceDimension::kTexture3D:
      return VK_IMAGE_TYPE_3D;
    default:
      return VK_IMAGE_TYPE_2D;
  }
}

bool wants_storage(const rtapi::TextureDesc& desc) {
  return rtapi::HasAny(desc.Flags, rtapi::ResourceFlags::kAllowUnorderedAccess);
}

}  // namespace

Image::Image(std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors,
             const rtapi::TextureDesc& desc)
    : gpu_(std::move(gpu)),
      descriptors_(std::move(descriptors)),
      desc_(desc),
      type_(image_type(desc.Dimension)),
      aspects_(image_format(desc).aspects) {}

Image::~Image() {
  for (const View& view : views_) {
    descriptors_->remove(
        view.desc.unordered_access ? BindlessArray::kStorageImages : BindlessArray::kSampledImages,
        view.index);
    gpu_->vk().vkDestroyImageView(gpu_->device(), view.view, nullptr);
    gpu_->vk().vkDestroyImageView(gpu_->device(), view.other_form, nullptr);
  }
  for (const DrawnView& view : drawn_views_) {
    gpu_->vk().vkDestroyImageView(gpu_->device(), view.view, nullptr);
  }
  gpu_->vk().vkDestroyImage(gpu_->device(), handle_, nullptr);
  gpu_->vk().vkFreeMemory(gpu_->device(), memory_, nullptr);
}

VkExtent3D Image::extent(uint32_t mip) const {
  return {std::max(desc_.Width >> mip, 1u), std::max(desc_.Height >> mip, 1u),
          type_ == VK_IMAGE_TYPE_3D ? std::max(uint32_t{desc_.DepthOrArraySize} >> mip, 1u) : 1u};
}

bool Image::typeless() const {
  return rtapi::GetFormatInfo(desc_.Format).type == rtapi::FormatClass::kTypeless;
}

// Textures of which views may have another format. Those of floating point have no such relatives.
// [D3D12: Relaxed Format Casting Rules]
bool Image::mutable_format() const {
  if ((aspects_ & VK_IMAGE_ASPECT_COLOR_BIT) == 0) return false;
  return rtapi::GetFormatInfo(desc_.Format).type != rtapi::FormatClass::kFloat;
}

std::string Image::description() const {
  return "\"" + desc_.Name + "\" (" + std::to_string(desc_.Width) + "x" +
         std::to_string(desc_.Height) + "x" + std::to_string(desc_.DepthOrArraySize) + ", " +
         std::to_string(desc_.MipLevels) + " mips, DXGI format " +
         std::to_string(static_cast<uint32_t>(desc_.Format)) + ")";
}

rtapi::Result<std::shared_ptr<Image>> Image::create(std::shared_ptr<Gpu> gpu,
                                                    std::shared_ptr<DescriptorSet> descriptors,
                                                    const rtapi::TextureDesc& desc,
                                                    const runtime::HeapPlace* place) {
  std::shared_ptr<Image> image(new Image(std::move(gpu), std::move(descriptors), desc));
  const VkImageCreateInfo info = image->create_info();
  if (auto s = image->check_support(info); !s) return s.error();
  if (place != nullptr && image->can_be_placed(info)) {
    if (auto s = image->import_pages(info, *place); !s) return s.error();
    if (auto s = image->enter_layout(); !s) return s.error();
    return image;
  }
  if (auto s = image->allocate(info); !s) return s.error();
  if (auto s = image->fill_with_zeros(); !s) return s.error();
  return image;
}

namespace {

constexpr auto kPages = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;

const VkExternalMemoryImageCreateInfo kFromPages = {
    VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_IMAGE_CREATE_INFO, nullptr, kPages};

}  // namespace

uint64_t Image::placed_bytes(const std::shared_ptr<Gpu>& gpu,
                             const std::shared_ptr<DescriptorSet>& descriptors,
                             const rtapi::TextureDesc& desc) {
  const Image image(gpu, descriptors, desc);
  VkImageCreateInfo info = image.create_info();
  if (info.format == VK_FORMAT_UNDEFINED || !image.can_be_placed(info)) return 0;
  info.pNext = &kFromPages;
  VkDeviceImageMemoryRequirements of = {VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS};
  of.pCreateInfo = &info;
  VkMemoryRequirements2 needs = {VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
  gpu->vk().vkGetDeviceImageMemoryRequirements(gpu->device(), &of, &needs);
  return needs.memoryRequirements.size;
}

bool Image::can_be_placed(const VkImageCreateInfo& info) const {
  if (!gpu_->imports_pages() || block_side() != 1) return false;
  VkPhysicalDeviceExternalImageFormatInfo external = {
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_IMAGE_FORMAT_INFO, nullptr, kPages};
  VkPhysicalDeviceImageFormatInfo2 format = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGE_FORMAT_INFO_2,
                                             &external};
  format.format = info.format;
  format.type = info.imageType;
  format.tiling = info.tiling;
  format.usage = info.usage;
  format.flags = info.flags;
  VkExternalImageFormatProperties found = {VK_STRUCTURE_TYPE_EXTERNAL_IMAGE_FORMAT_PROPERTIES};
  VkImageFormatProperties2 limits = {VK_STRUCTURE_TYPE_IMAGE_FORMAT_PROPERTIES_2, &found};
  const VkResult r =
      vkGetPhysicalDeviceImageFormatProperties2(gpu_->physical_device(), &format, &limits);
  return r == VK_SUCCESS && (found.externalMemoryProperties.externalMemoryFeatures &
                             VK_EXTERNAL_MEMORY_FEATURE_IMPORTABLE_BIT) != 0;
}

rtapi::Status Image::import_pages(VkImageCreateInfo info, const runtime::HeapPlace& place) {
  const VolkDeviceTable& vk = gpu_->vk();
  const std::string what = "texture " + description();
  pages_ = place.map();
  if (!pages_) return gpu_->error(VK_ERROR_OUT_OF_HOST_MEMORY, what);
  info.pNext = &kFromPages;
  VkResult r = vk.vkCreateImage(gpu_->device(), &info, nullptr, &handle_);
  if (r != VK_SUCCESS) return gpu_->error(r, what);
  VkMemoryRequirements needs;
  vk.vkGetImageMemoryRequirements(gpu_->device(), handle_, &needs);
  VkMemoryHostPointerPropertiesEXT types = {VK_STRUCTURE_TYPE_MEMORY_HOST_POINTER_PROPERTIES_EXT};
  r = vk.vkGetMemoryHostPointerPropertiesEXT(gpu_->device(), kPages, pages_.first(), &types);
  if (r != VK_SUCCESS) return gpu_->error(r, what);
  VkImportMemoryHostPointerInfoEXT from = {VK_STRUCTURE_TYPE_IMPORT_MEMORY_HOST_POINTER_INFO_EXT};
  from.handleType = kPages;
  from.pHostPointer = pages_.first();
  VkMemoryAllocateInfo allocate = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &from};
  allocate.allocationSize = pages_.size_bytes();
  allocate.memoryTypeIndex = gpu_->memory_type(needs.memoryTypeBits & types.memoryTypeBits, 0);
  r = vk.vkAllocateMemory(gpu_->device(), &allocate, nullptr, &memory_);
  if (r == VK_SUCCESS) r = vk.vkBindImageMemory(gpu_->device(), handle_, memory_, 0);
  if (r != VK_SUCCESS) return gpu_->error(r, what);
  return {};
}

VkImageCreateInfo Image::create_info() const {
  VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = type_;
  info.format = image_format(desc_).format;
  info.extent = extent(0);
  info.mipLevels = desc_.MipLevels;
  info.arrayLayers = array_size();
  info.samples = static_cast<VkSampleCountFlagBits>(desc_.SampleDesc.Count);
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
               VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (wants_storage(desc_)) info.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  if (rtapi::HasAny(desc_.Flags, rtapi::ResourceFlags::kAllowRenderTarget)) {
    info.usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (type_ == VK_IMAGE_TYPE_3D) info.flags |= VK_IMAGE_CREATE_2D_ARRAY_COMPATIBLE_BIT;
  }
  if (rtapi::HasAny(desc_.Flags, rtapi::ResourceFlags::kAllowDepthStencil)) {
    info.usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  }
  // Views have their own formats, some of which cannot be storage images or targets.
  if (mutable_format()) {
    info.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT | VK_IMAGE_CREATE_EXTENDED_USAGE_BIT;
  }
  if (type_ == VK_IMAGE_TYPE_2D && info.arrayLayers >= 6 && desc_.Width == desc_.Height &&
      desc_.SampleDesc.Count == 1) {
    info.flags |= VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
  }
  return info;
}

rtapi::Status Image::check_support(const VkImageCreateInfo& info) const {
  const auto unsupported = [&](const std::string& why) {
    return runtime::make_error(runtime::Id::kTextureUnsupported,
                               description() + " on " + gpu_->info().Name + ": " + why + ".");
  };
  if (info.format == VK_FORMAT_UNDEFINED) {
    return unsupported("the Vulkan backend does not know this format");
  }
  const bool needs_storage = wants_storage(desc_) && !typeless();
  if (needs_storage && (!texture_format(desc_.Format).plain ||
                        !can_be_storage(gpu_->physical_device(), info.format))) {
    return unsupported(
        "the format does not support unordered access; create it without "
        "kAllowUnorderedAccess");
  }
  VkImageFormatProperties limits = {};
  const VkResult r =
      vkGetPhysicalDeviceImageFormatProperties(gpu_->physical_device(), info.format, info.imageType,
                                               info.tiling, info.usage, info.flags, &limits);
  if (r == VK_ERROR_FORMAT_NOT_SUPPORTED)
    return unsupported("the device does not support the format");
  if (r != VK_SUCCESS) return gpu_->error(r, "texture " + description());
  if (info.extent.width > limits.maxExtent.width || info.extent.height > limits.maxExtent.height ||
      info.extent.depth > limits.maxExtent.depth || info.arrayLayers > limits.maxArrayLayers ||
      info.mipLevels > limits.maxMipLevels) {
    return unsupported("the device allows at most " + std::to_string(limits.maxExtent.width) + "x" +
                       std::to_string(limits.maxExtent.height) + "x" +
                       std::to_string(limits.maxExtent.depth) + " with " +
                       std::to_string(limits.maxArrayLayers) + " array elements and " +
                       std::to_string(limits.maxMipLevels) + " mips");
  }
  if ((limits.sampleCounts & info.samples) == 0) {
    return unsupported("the device has no such textures with " +
                       std::to_string(desc_.SampleDesc.Count) + " samples");
  }
  return {};
}

rtapi::Status Image::allocate(const VkImageCreateInfo& info) {
  const VolkDeviceTable& vk = gpu_->vk();
  const std::string what = "texture " + description();
  VkResult r = vk.vkCreateImage(gpu_->device(), &info, nullptr, &handle_);
  if (r != VK_SUCCESS) return gpu_->error(r, what);
  VkMemoryRequirements needs;
  vk.vkGetImageMemoryRequirements(gpu_->device(), handle_, &needs);
  VkMemoryAllocateInfo allocate = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex =
      gpu_->memory_type(needs.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  r = vk.vkAllocateMemory(gpu_->device(), &allocate, nullptr, &memory_);
  if (r == VK_SUCCESS) r = vk.vkBindImageMemory(gpu_->device(), handle_, memory_, 0);
  if (r != VK_SUCCESS) return gpu_->error(r, what);
  return {};
}

constexpr uint64_t kZeroBytes = 1 << 20;

// Clears do not take block-compressed images: a few rows of zeros are copied to everywhere.
void Image::clear_blocks(VkCommandBuffer commands, const GpuBuffer& zeros) const {
  std::vector<VkBufferImageCopy> regions;
  for (uint32_t mip = 0; mip < desc_.MipLevels; ++mip) {
    const VkExtent3D size = extent(mip);
    const uint64_t row_bytes =
        uint64_t{(size.width + block_side() - 1) / block_side()} * element_bytes();
    const auto rows = static_cast<uint32_t>(std::max<uint64_t>(kZeroBytes / row_bytes, 1));
    for (uint32_t y = 0; y < size.height; y += rows * block_side()) {
      for (uint32_t slice = 0; slice < array_size() * size.depth; ++slice) {
        const bool volume = type_ == VK_IMAGE_TYPE_3D;
        VkBufferImageCopy& region = regions.emplace_back();
        region = {};
        region.bufferOffset = (zeros.offset() + 15) / 16 * 16;
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip, volume ? 0 : slice, 1};
        region.imageOffset = {0, static_cast<int32_t>(y), volume ? static_cast<int32_t>(slice) : 0};
        region.imageExtent = {size.width, std::min(rows * block_side(), size.height - y), 1};
      }
    }
  }
  gpu_->vk().vkCmdCopyBufferToImage(commands, zeros.handle(), handle_, VK_IMAGE_LAYOUT_GENERAL,
                                    static_cast<uint32_t>(regions.size()), regions.data());
}

VkImageMemoryBarrier Image::first_barrier() const {
  VkImageMemoryBarrier barrier = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
  barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = handle_;
  barrier.subresourceRange = {aspects_, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
  return barrier;
}

// Where memory is that of the processor, this leaves the texels as they are.
rtapi::Status Image::enter_layout() {
  return gpu_->run(
      [&](VkCommandBuffer commands) {
        const VkImageMemoryBarrier barrier = first_barrier();
        gpu_->vk().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                        VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr,
                                        1, &barrier);
      },
      "first use of texture " + description());
}

rtapi::Status Image::fill_with_zeros() {
  const std::string what = "clear of texture " + description();
  std::unique_ptr<GpuBuffer> zeros;
  if (block_side() != 1) {
    // Rows of 16384 texels have 64 KiB.
    auto made = gpu_->create_buffer(kZeroBytes + 16, what);
    if (!made) return made.error();
    zeros = std::move(*made);
  }
  return gpu_->run(
      [&](VkCommandBuffer commands) {
        const VkImageMemoryBarrier barrier = first_barrier();
        gpu_->vk().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                        VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr,
                                        1, &barrier);
        if (zeros != nullptr) return clear_blocks(commands, *zeros);
        if ((aspects_ & VK_IMAGE_ASPECT_COLOR_BIT) == 0) {
          const VkClearDepthStencilValue nearest = {};
          gpu_->vk().vkCmdClearDepthStencilImage(commands, handle_, VK_IMAGE_LAYOUT_GENERAL,
                                                 &nearest, 1, &barrier.subresourceRange);
          return;
        }
        const VkClearColorValue black = {};
        gpu_->vk().vkCmdClearColorImage(commands, handle_, VK_IMAGE_LAYOUT_GENERAL, &black, 1,
                                        &barrier.subresourceRange);
      },
      what);
}

}  // namespace kaamos::vulkan
