// SPDX-License-Identifier: MIT
//
// Views of images: in the bindless set, and as targets of draws.
#include <algorithm>
#include <string>

#include "runtime/backend/errors.h"
#include "runtime/vulkan/textures/image.h"
#include "runtime/vulkan/textures/texture_format.h"

namespace kaamos::vulkan {
namespace {

using rtapi::SrvDimension;
using runtime::TextureViewDesc;

VkImageViewType view_type(SrvDimension dimension) {
  switch (dimension) {
    case SrvDimension::kTexture1D:
      return VK_IMAGE_VIEW_TYPE_1D;
    case SrvDimension::kTexture1DArray:
      return VK_IMAGE_VIEW_TYPE_1D_ARRAY;
    case SrvDimension::kTexture2DArray:
    case SrvDimension::kTexture2DMSArray:
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

TextureFormat format_of(const TextureViewDesc& desc, VkImageAspectFlags image_aspects) {
  return (image_aspects & VK_IMAGE_ASPECT_COLOR_BIT) != 0 ? texture_format(desc.format)
                                                          : depth_view_format(desc.format);
}

}  // namespace

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
                                   " of texture " + description() + " on " + gpu_->info().Name +
                                   ": " + why + ".");
  };
  const TextureFormat format = format_of(desc, aspects_);
  if (format.format == VK_FORMAT_UNDEFINED)
    return unsupported("the Vulkan backend does not know this format");
  if (desc.unordered_access &&
      (!format.plain || !can_be_storage(gpu_->physical_device(), format.format))) {
    return unsupported("the format does not support unordered access");
  }
  if (!desc.unordered_access && (format_features(gpu_->physical_device(), format.format) &
                                 VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_BIT) == 0) {
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
  const TextureFormat format = format_of(desc, aspects_);
  const bool volume = type_ == VK_IMAGE_TYPE_3D;
  VkImageViewUsageCreateInfo usage = {VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO};
  usage.usage = desc.unordered_access ? VK_IMAGE_USAGE_STORAGE_BIT : VK_IMAGE_USAGE_SAMPLED_BIT;
  VkImageViewMinLodCreateInfoEXT min_lod = {VK_STRUCTURE_TYPE_IMAGE_VIEW_MIN_LOD_CREATE_INFO_EXT};
  VkImageViewCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.pNext = &usage;
  info.image = handle_;
  info.viewType = view_type(desc.dimension);
  info.format = format.format;
  info.subresourceRange = {format.aspects, desc.first_mip, desc.mip_count,
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
  if (r != VK_SUCCESS) return gpu_->error(r, "view of texture " + description());
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
    case SrvDimension::kTexture2DMS:
      other.dimension = SrvDimension::kTexture2DMSArray;
      break;
    case SrvDimension::kTexture2DMSArray:
      other.dimension = SrvDimension::kTexture2DMS;
      other.slice_count = 1;
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

rtapi::Result<VkImageView> Image::target_view(const runtime::TargetView& target) {
  const TextureFormat format = texture_format(target.format);
  const std::lock_guard lock(mutex_);
  for (const DrawnView& known : drawn_views_) {
    if (known.format == format.format && known.mip == target.mip &&
        known.first_slice == target.first_slice && known.slice_count == target.slice_count) {
      return known.view;
    }
  }
  VkImageViewUsageCreateInfo usage = {VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO};
  usage.usage = (aspects_ & VK_IMAGE_ASPECT_COLOR_BIT) != 0
                    ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
                    : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  VkImageViewCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.pNext = &usage;
  info.image = handle_;
  // Of a volume, these are slices of its depth. [Vulkan: VK_IMAGE_CREATE_2D_ARRAY_COMPATIBLE_BIT]
  info.viewType = target.slice_count == 1 ? VK_IMAGE_VIEW_TYPE_2D : VK_IMAGE_VIEW_TYPE_2D_ARRAY;
  if (type_ == VK_IMAGE_TYPE_1D) {
    info.viewType = target.slice_count == 1 ? VK_IMAGE_VIEW_TYPE_1D : VK_IMAGE_VIEW_TYPE_1D_ARRAY;
  }
  info.format = format.format;
  info.subresourceRange = {aspects_, target.mip, 1, target.first_slice, target.slice_count};
  VkImageView view = VK_NULL_HANDLE;
  const VkResult r = gpu_->vk().vkCreateImageView(gpu_->device(), &info, nullptr, &view);
  if (r != VK_SUCCESS) return gpu_->error(r, "view of target " + description());
  drawn_views_.push_back({format.format, target.mip, target.first_slice, target.slice_count, view});
  return view;
}

}  // namespace kaamos::vulkan
