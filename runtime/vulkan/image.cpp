// SPDX-License-Identifier: MIT
#include "runtime/vulkan/image.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/backend/errors.h"
#include "runtime/vulkan/texture_format.h"

namespace kaamos::vulkan {
namespace {

using rtapi::SrvDimension;
using runtime::TextureViewDesc;

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

VkImageViewType view_type(SrvDimension dimension) {
  switch (dimension) {
    case SrvDimension::kTexture1D:
      return VK_IMAGE_VIEW_TYPE_1D;
    case SrvDimension::kTexture1DArray:
      return VK_IMAGE_VIEW_TYPE_1D_ARRAY;
    case SrvDimension::kTexture2DArray:
      return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    case SrvDimension::kTexture3D:
      return VK_IMAGE_VIEW_TYPE_3D;
    case SrvDimension::kTextureCube:
      return VK_IMAGE_VIEW_TYPE_CUBE;
    case SrvDimension::kTextureCubeArray:
      return VK_IMAGE_VIEW_TYPE_CUBE_ARRAY;
    default:
      return VK_IMAGE_VIEW_TYPE_2D;
  }
}

bool wants_storage(const rtapi::TextureDesc& desc) {
  return rtapi::HasAny(desc.Flags, rtapi::ResourceFlags::kAllowUnorderedAccess);
}

VkFormatFeatureFlags2 features_of(const Gpu& gpu, VkFormat format) {
  VkFormatProperties3 properties3 = {VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_3};
  VkFormatProperties2 properties = {VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_2};
  properties.pNext = &properties3;
  vkGetPhysicalDeviceFormatProperties2(gpu.physical_device(), format, &properties);
  return properties3.optimalTilingFeatures;
}

constexpr VkFormatFeatureFlags2 kStorageFeatures =
    VK_FORMAT_FEATURE_2_STORAGE_IMAGE_BIT | VK_FORMAT_FEATURE_2_STORAGE_READ_WITHOUT_FORMAT_BIT |
    VK_FORMAT_FEATURE_2_STORAGE_WRITE_WITHOUT_FORMAT_BIT;

bool can_be_storage(const Gpu& gpu, VkFormat format) {
  return (features_of(gpu, format) & kStorageFeatures) == kStorageFeatures;
}

std::string describe(const rtapi::TextureDesc& desc) {
  return "\"" + desc.Name + "\" (" + std::to_string(desc.Width) + "x" +
         std::to_string(desc.Height) + "x" + std::to_string(desc.DepthOrArraySize) + ", " +
         std::to_string(desc.MipLevels) + " mips, DXGI format " +
         std::to_string(static_cast<uint32_t>(desc.Format)) + ")";
}

VkComponentSwizzle swizzle_of(uint8_t source, const VkComponentMapping& channels) {
  switch (source) {
    case 0:
      return channels.r;
    case 1:
      return channels.g;
    case 2:
      return channels.b;
    case 3:
      return channels.a;
    case 5:
      return VK_COMPONENT_SWIZZLE_ONE;
    default:
      return VK_COMPONENT_SWIZZLE_ZERO;
  }
}

}  // namespace

Image::Image(std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors,
             const rtapi::TextureDesc& desc)
    : gpu_(std::move(gpu)),
      descriptors_(std::move(descriptors)),
      desc_(desc),
      type_(image_type(desc.Dimension)) {}

Image::~Image() {
  for (const View& view : views_) {
    descriptors_->remove(
        view.desc.unordered_access ? BindlessArray::kStorageImages : BindlessArray::kSampledImages,
        view.index);
    gpu_->vk().vkDestroyImageView(gpu_->device(), view.view, nullptr);
    gpu_->vk().vkDestroyImageView(gpu_->device(), view.other_form, nullptr);
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

rtapi::Result<std::shared_ptr<Image>> Image::create(std::shared_ptr<Gpu> gpu,
                                                    std::shared_ptr<DescriptorSet> descriptors,
                                                    const rtapi::TextureDesc& desc) {
  std::shared_ptr<Image> image(new Image(std::move(gpu), std::move(descriptors), desc));
  const VkImageCreateInfo info = image->create_info();
  if (auto s = image->check_support(info); !s) return s.error();
  if (auto s = image->allocate(info); !s) return s.error();
  if (auto s = image->fill_with_zeros(); !s) return s.error();
  return image;
}

VkImageCreateInfo Image::create_info() const {
  VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = type_;
  info.format = texture_format(desc_.Format).format;
  info.extent = extent(0);
  info.mipLevels = desc_.MipLevels;
  info.arrayLayers = array_size();
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
               VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (wants_storage(desc_)) info.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  // Views of typeless textures have their own formats, some of which cannot be storage images.
  if (typeless()) {
    info.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT | VK_IMAGE_CREATE_EXTENDED_USAGE_BIT;
  }
  if (type_ == VK_IMAGE_TYPE_2D && info.arrayLayers >= 6 && desc_.Width == desc_.Height) {
    info.flags |= VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
  }
  return info;
}

rtapi::Status Image::check_support(const VkImageCreateInfo& info) const {
  const auto unsupported = [&](const std::string& why) {
    return runtime::make_error(runtime::Id::kTextureUnsupported,
                               describe(desc_) + " on " + gpu_->info().Name + ": " + why + ".");
  };
  if (info.format == VK_FORMAT_UNDEFINED) {
    return unsupported("the Vulkan backend does not know this format");
  }
  const bool needs_storage = wants_storage(desc_) && !typeless();
  if (needs_storage &&
      (!texture_format(desc_.Format).plain || !can_be_storage(*gpu_, info.format))) {
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
  if (r != VK_SUCCESS) return gpu_->error(r, "texture " + describe(desc_));
  if (info.extent.width > limits.maxExtent.width || info.extent.height > limits.maxExtent.height ||
      info.extent.depth > limits.maxExtent.depth || info.arrayLayers > limits.maxArrayLayers ||
      info.mipLevels > limits.maxMipLevels) {
    return unsupported("the device allows at most " + std::to_string(limits.maxExtent.width) + "x" +
                       std::to_string(limits.maxExtent.height) + "x" +
                       std::to_string(limits.maxExtent.depth) + " with " +
                       std::to_string(limits.maxArrayLayers) + " array elements and " +
                       std::to_string(limits.maxMipLevels) + " mips");
  }
  return {};
}

rtapi::Status Image::allocate(const VkImageCreateInfo& info) {
  const VolkDeviceTable& vk = gpu_->vk();
  const std::string what = "texture " + describe(desc_);
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

rtapi::Status Image::fill_with_zeros() {
  const std::string what = "clear of texture " + describe(desc_);
  std::unique_ptr<GpuBuffer> zeros;
  if (block_side() != 1) {
    // Rows of 16384 texels have 64 KiB.
    auto made = gpu_->create_buffer(kZeroBytes + 16, what);
    if (!made) return made.error();
    zeros = std::move(*made);
  }
  return gpu_->run(
      [&](VkCommandBuffer commands) {
        VkImageMemoryBarrier barrier = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
        barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = handle_;
        barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                    VK_REMAINING_ARRAY_LAYERS};
        gpu_->vk().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                        VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr,
                                        1, &barrier);
        if (zeros != nullptr) return clear_blocks(commands, *zeros);
        const VkClearColorValue black = {};
        gpu_->vk().vkCmdClearColorImage(commands, handle_, VK_IMAGE_LAYOUT_GENERAL, &black, 1,
                                        &barrier.subresourceRange);
      },
      what);
}

rtapi::Result<uint64_t> Image::view(const TextureViewDesc& desc) {
  const std::lock_guard lock(mutex_);
  for (const View& known : views_) {
    if (known.desc == desc) return uint64_t{known.index};
  }
  if (auto s = check_view(desc); !s) return s.error();
  auto view = create_view(desc);
  if (!view) return view.error();
  auto other = create_other_form(desc);
  if (!other) {
    gpu_->vk().vkDestroyImageView(gpu_->device(), *view, nullptr);
    return other.error();
  }
  auto index = desc.unordered_access ? descriptors_->add_storage_images(*view, *other)
                                     : descriptors_->add_sampled_images(*view, *other);
  if (!index) {
    gpu_->vk().vkDestroyImageView(gpu_->device(), *view, nullptr);
    gpu_->vk().vkDestroyImageView(gpu_->device(), *other, nullptr);
    return index.error();
  }
  views_.push_back({desc, *view, *other, *index});
  return uint64_t{*index};
}

std::optional<TextureViewDesc> Image::storage_view(uint64_t index) const {
  const std::lock_guard lock(mutex_);
  for (const View& known : views_) {
    if (known.desc.unordered_access && known.index == index) return known.desc;
  }
  return std::nullopt;
}

rtapi::Status Image::check_view(const TextureViewDesc& desc) const {
  const auto unsupported = [&](const std::string& why) {
    return runtime::make_error(runtime::Id::kViewUnsupported,
                               "DXGI format " + std::to_string(static_cast<uint32_t>(desc.format)) +
                                   " of texture " + describe(desc_) + " on " + gpu_->info().Name +
                                   ": " + why + ".");
  };
  const TextureFormat format = texture_format(desc.format);
  if (format.format == VK_FORMAT_UNDEFINED)
    return unsupported("the Vulkan backend does not know this format");
  if (desc.unordered_access && (!format.plain || !can_be_storage(*gpu_, format.format))) {
    return unsupported("the format does not support unordered access");
  }
  if (!desc.unordered_access &&
      (features_of(*gpu_, format.format) & VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_BIT) == 0) {
    return unsupported("the format cannot be sampled");
  }
  if (desc.dimension == SrvDimension::kTextureCubeArray && !gpu_->features().image_cube_array) {
    return unsupported("the device has no cube arrays (imageCubeArray)");
  }
  const bool part_of_volume =
      type_ == VK_IMAGE_TYPE_3D && desc.unordered_access &&
      (desc.first_slice != 0 || desc.slice_count != extent(desc.first_mip).depth);
  if (part_of_volume) {
    return unsupported("unordered access to only some slices of a volume; view all " +
                       std::to_string(extent(desc.first_mip).depth) + " of them");
  }
  return {};
}

rtapi::Result<VkImageView> Image::create_view(const TextureViewDesc& desc) const {
  const TextureFormat format = texture_format(desc.format);
  const bool volume = type_ == VK_IMAGE_TYPE_3D;
  VkImageViewUsageCreateInfo usage = {VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO};
  usage.usage = desc.unordered_access ? VK_IMAGE_USAGE_STORAGE_BIT : VK_IMAGE_USAGE_SAMPLED_BIT;
  VkImageViewMinLodCreateInfoEXT min_lod = {VK_STRUCTURE_TYPE_IMAGE_VIEW_MIN_LOD_CREATE_INFO_EXT};
  VkImageViewCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.pNext = &usage;
  info.image = handle_;
  info.viewType = view_type(desc.dimension);
  info.format = format.format;
  info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, desc.first_mip, desc.mip_count,
                           volume ? 0 : desc.first_slice, volume ? 1 : desc.slice_count};
  if (!desc.unordered_access) {
    info.components = {
        swizzle_of(desc.swizzle[0], format.channels), swizzle_of(desc.swizzle[1], format.channels),
        swizzle_of(desc.swizzle[2], format.channels), swizzle_of(desc.swizzle[3], format.channels)};
    if (desc.min_lod > 0 && gpu_->features().image_view_min_lod) {
      // Vulkan counts from the first mip of the image.
      min_lod.minLod = std::min(desc.min_lod, static_cast<float>(desc.mip_count - 1)) +
                       static_cast<float>(desc.first_mip);
      min_lod.pNext = info.pNext;
      info.pNext = &min_lod;
    }
  }
  VkImageView view = VK_NULL_HANDLE;
  const VkResult r = gpu_->vk().vkCreateImageView(gpu_->device(), &info, nullptr, &view);
  if (r != VK_SUCCESS) return gpu_->error(r, "view of texture " + describe(desc_));
  return view;
}

// An array of one for a single texture, the first element for an array.
// [kaamos::shader::fits_shape]
rtapi::Result<VkImageView> Image::create_other_form(const TextureViewDesc& desc) const {
  TextureViewDesc other = desc;
  switch (desc.dimension) {
    case SrvDimension::kTexture1D:
      other.dimension = SrvDimension::kTexture1DArray;
      break;
    case SrvDimension::kTexture2D:
      other.dimension = SrvDimension::kTexture2DArray;
      break;
    case SrvDimension::kTexture1DArray:
      other.dimension = SrvDimension::kTexture1D;
      other.slice_count = 1;
      break;
    case SrvDimension::kTexture2DArray:
      other.dimension = SrvDimension::kTexture2D;
      other.slice_count = 1;
      break;
    case SrvDimension::kTextureCube:
      if (!gpu_->features().image_cube_array) return VkImageView{VK_NULL_HANDLE};
      other.dimension = SrvDimension::kTextureCubeArray;
      break;
    case SrvDimension::kTextureCubeArray:
      other.dimension = SrvDimension::kTextureCube;
      other.slice_count = 6;
      break;
    default:
      return VkImageView{VK_NULL_HANDLE};
  }
  return create_view(other);
}

}  // namespace kaamos::vulkan
