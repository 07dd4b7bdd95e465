// SPDX-License-Identifier: MIT
#include "runtime/vulkan/textures/texture_format.h"

namespace kaamos::vulkan {
namespace {

using F = rtapi::Format;

VkFormat vulkan_format(F format) {
  switch (format) {
    case F::kR32G32B32A32Float:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
    case F::kR32G32B32A32Typeless:
    case F::kR32G32B32A32Uint:
      return VK_FORMAT_R32G32B32A32_UINT;
    case F::kR32G32B32A32Sint:
      return VK_FORMAT_R32G32B32A32_SINT;
    case F::kR32G32B32Float:
      return VK_FORMAT_R32G32B32_SFLOAT;
    case F::kR32G32B32Typeless:
    case F::kR32G32B32Uint:
      return VK_FORMAT_R32G32B32_UINT;
    case F::kR32G32B32Sint:
      return VK_FORMAT_R32G32B32_SINT;
    case F::kR16G16B16A16Float:
      return VK_FORMAT_R16G16B16A16_SFLOAT;
    case F::kR16G16B16A16Unorm:
      return VK_FORMAT_R16G16B16A16_UNORM;
    case F::kR16G16B16A16Typeless:
    case F::kR16G16B16A16Uint:
      return VK_FORMAT_R16G16B16A16_UINT;
    case F::kR16G16B16A16Snorm:
      return VK_FORMAT_R16G16B16A16_SNORM;
    case F::kR16G16B16A16Sint:
      return VK_FORMAT_R16G16B16A16_SINT;
    case F::kR32G32Float:
      return VK_FORMAT_R32G32_SFLOAT;
    case F::kR32G32Typeless:
    case F::kR32G32Uint:
      return VK_FORMAT_R32G32_UINT;
    case F::kR32G32Sint:
      return VK_FORMAT_R32G32_SINT;
    case F::kR10G10B10A2Unorm:
      return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
    case F::kR10G10B10A2Typeless:
    case F::kR10G10B10A2Uint:
      return VK_FORMAT_A2B10G10R10_UINT_PACK32;
    case F::kR11G11B10Float:
      return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
    case F::kR8G8B8A8Unorm:
      return VK_FORMAT_R8G8B8A8_UNORM;
    case F::kR8G8B8A8UnormSrgb:
      return VK_FORMAT_R8G8B8A8_SRGB;
    case F::kR8G8B8A8Typeless:
    case F::kR8G8B8A8Uint:
      return VK_FORMAT_R8G8B8A8_UINT;
    case F::kR8G8B8A8Snorm:
      return VK_FORMAT_R8G8B8A8_SNORM;
    case F::kR8G8B8A8Sint:
      return VK_FORMAT_R8G8B8A8_SINT;
    case F::kR16G16Float:
      return VK_FORMAT_R16G16_SFLOAT;
    case F::kR16G16Unorm:
      return VK_FORMAT_R16G16_UNORM;
    case F::kR16G16Typeless:
    case F::kR16G16Uint:
      return VK_FORMAT_R16G16_UINT;
    case F::kR16G16Snorm:
      return VK_FORMAT_R16G16_SNORM;
    case F::kR16G16Sint:
      return VK_FORMAT_R16G16_SINT;
    case F::kR32Float:
      return VK_FORMAT_R32_SFLOAT;
    case F::kR32Typeless:
    case F::kR32Uint:
      return VK_FORMAT_R32_UINT;
    case F::kR32Sint:
      return VK_FORMAT_R32_SINT;
    case F::kR8G8Unorm:
      return VK_FORMAT_R8G8_UNORM;
    case F::kR8G8Typeless:
    case F::kR8G8Uint:
      return VK_FORMAT_R8G8_UINT;
    case F::kR8G8Snorm:
      return VK_FORMAT_R8G8_SNORM;
    case F::kR8G8Sint:
      return VK_FORMAT_R8G8_SINT;
    case F::kR16Float:
      return VK_FORMAT_R16_SFLOAT;
    case F::kR16Unorm:
      return VK_FORMAT_R16_UNORM;
    case F::kR16Typeless:
    case F::kR16Uint:
      return VK_FORMAT_R16_UINT;
    case F::kR16Snorm:
      return VK_FORMAT_R16_SNORM;
    case F::kR16Sint:
      return VK_FORMAT_R16_SINT;
    case F::kR8Unorm:
    case F::kA8Unorm:
      return VK_FORMAT_R8_UNORM;
    case F::kR8Typeless:
    case F::kR8Uint:
      return VK_FORMAT_R8_UINT;
    case F::kR8Snorm:
      return VK_FORMAT_R8_SNORM;
    case F::kR8Sint:
      return VK_FORMAT_R8_SINT;
    case F::kR9G9B9E5Sharedexp:
      return VK_FORMAT_E5B9G9R9_UFLOAT_PACK32;
    case F::kB5G6R5Unorm:
      return VK_FORMAT_R5G6B5_UNORM_PACK16;
    case F::kB5G5R5A1Unorm:
      return VK_FORMAT_A1R5G5B5_UNORM_PACK16;
    case F::kB8G8R8A8Typeless:
    case F::kB8G8R8A8Unorm:
    case F::kB8G8R8X8Typeless:
    case F::kB8G8R8X8Unorm:
      return VK_FORMAT_B8G8R8A8_UNORM;
    case F::kB8G8R8A8UnormSrgb:
    case F::kB8G8R8X8UnormSrgb:
      return VK_FORMAT_B8G8R8A8_SRGB;
    case F::kBC1Typeless:
    case F::kBC1Unorm:
      return VK_FORMAT_BC1_RGBA_UNORM_BLOCK;
    case F::kBC1UnormSrgb:
      return VK_FORMAT_BC1_RGBA_SRGB_BLOCK;
    case F::kBC2Typeless:
    case F::kBC2Unorm:
      return VK_FORMAT_BC2_UNORM_BLOCK;
    case F::kBC2UnormSrgb:
      return VK_FORMAT_BC2_SRGB_BLOCK;
    case F::kBC3Typeless:
    case F::kBC3Unorm:
      return VK_FORMAT_BC3_UNORM_BLOCK;
    case F::kBC3UnormSrgb:
      return VK_FORMAT_BC3_SRGB_BLOCK;
    case F::kBC4Typeless:
    case F::kBC4Unorm:
      return VK_FORMAT_BC4_UNORM_BLOCK;
    case F::kBC4Snorm:
      return VK_FORMAT_BC4_SNORM_BLOCK;
    case F::kBC5Typeless:
    case F::kBC5Unorm:
      return VK_FORMAT_BC5_UNORM_BLOCK;
    case F::kBC5Snorm:
      return VK_FORMAT_BC5_SNORM_BLOCK;
    case F::kBC6HTypeless:
    case F::kBC6HUf16:
      return VK_FORMAT_BC6H_UFLOAT_BLOCK;
    case F::kBC6HSf16:
      return VK_FORMAT_BC6H_SFLOAT_BLOCK;
    case F::kBC7Typeless:
    case F::kBC7Unorm:
      return VK_FORMAT_BC7_UNORM_BLOCK;
    case F::kBC7UnormSrgb:
      return VK_FORMAT_BC7_SRGB_BLOCK;
    case F::kD16Unorm:
      return VK_FORMAT_D16_UNORM;
    case F::kD32Float:
      return VK_FORMAT_D32_SFLOAT;
    case F::kR24G8Typeless:
    case F::kD24UnormS8Uint:
    case F::kR24UnormX8Typeless:
    case F::kX24TypelessG8Uint:
      return VK_FORMAT_D24_UNORM_S8_UINT;
    case F::kR32G8X24Typeless:
    case F::kD32FloatS8X24Uint:
    case F::kR32FloatX8X24Typeless:
    case F::kX32TypelessG8X24Uint:
      return VK_FORMAT_D32_SFLOAT_S8_UINT;
    default:
      return VK_FORMAT_UNDEFINED;
  }
}

constexpr VkComponentMapping kOnlyRed = {VK_COMPONENT_SWIZZLE_R, VK_COMPONENT_SWIZZLE_ZERO,
                                         VK_COMPONENT_SWIZZLE_ZERO, VK_COMPONENT_SWIZZLE_ONE};
// Vulkan gives stencil as red, D3D as green.
constexpr VkComponentMapping kRedAsGreen = {VK_COMPONENT_SWIZZLE_ZERO, VK_COMPONENT_SWIZZLE_R,
                                            VK_COMPONENT_SWIZZLE_ZERO, VK_COMPONENT_SWIZZLE_ONE};

TextureFormat one_of_depth(VkFormat format, VkImageAspectFlags aspect) {
  const bool stencil = aspect == VK_IMAGE_ASPECT_STENCIL_BIT;
  return {format, stencil ? kRedAsGreen : kOnlyRed, false, aspect};
}

VkImageAspectFlags aspects_of(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_D32_SFLOAT:
      return VK_IMAGE_ASPECT_DEPTH_BIT;
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    default:
      return VK_IMAGE_ASPECT_COLOR_BIT;
  }
}

}  // namespace

TextureFormat texture_format(F format) {
  TextureFormat result;
  result.format = vulkan_format(format);
  result.aspects = aspects_of(result.format);
  switch (format) {
    case F::kR24UnormX8Typeless:
    case F::kR32FloatX8X24Typeless:
      return one_of_depth(result.format, VK_IMAGE_ASPECT_DEPTH_BIT);
    case F::kX24TypelessG8Uint:
    case F::kX32TypelessG8X24Uint:
      return one_of_depth(result.format, VK_IMAGE_ASPECT_STENCIL_BIT);
    case F::kA8Unorm:
      result.channels = {VK_COMPONENT_SWIZZLE_ZERO, VK_COMPONENT_SWIZZLE_ZERO,
                         VK_COMPONENT_SWIZZLE_ZERO, VK_COMPONENT_SWIZZLE_R};
      result.plain = false;
      break;
    case F::kB8G8R8X8Unorm:
    case F::kB8G8R8X8UnormSrgb:
      result.channels.a = VK_COMPONENT_SWIZZLE_ONE;  // no read returns what stores put there
      break;
    default:
      break;
  }
  return result;
}

TextureFormat depth_view_format(F format) {
  if (format == F::kR32Float) {
    return one_of_depth(VK_FORMAT_D32_SFLOAT, VK_IMAGE_ASPECT_DEPTH_BIT);
  }
  if (format == F::kR16Unorm) return one_of_depth(VK_FORMAT_D16_UNORM, VK_IMAGE_ASPECT_DEPTH_BIT);
  const TextureFormat result = texture_format(format);
  return (result.aspects & VK_IMAGE_ASPECT_COLOR_BIT) == 0 ? result : TextureFormat();
}

TextureFormat image_format(const rtapi::TextureDesc& desc) {
  const bool depth = rtapi::HasAny(desc.Flags, rtapi::ResourceFlags::kAllowDepthStencil);
  return texture_format(depth ? rtapi::GetDepthFormat(desc.Format) : desc.Format);
}

VkFormatFeatureFlags2 format_features(VkPhysicalDevice device, VkFormat format) {
  VkFormatProperties3 properties3 = {VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_3};
  VkFormatProperties2 properties = {VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_2};
  properties.pNext = &properties3;
  vkGetPhysicalDeviceFormatProperties2(device, format, &properties);
  return properties3.optimalTilingFeatures;
}

bool can_be_storage(VkPhysicalDevice device, VkFormat format) {
  constexpr VkFormatFeatureFlags2 kNeeded = VK_FORMAT_FEATURE_2_STORAGE_IMAGE_BIT |
                                            VK_FORMAT_FEATURE_2_STORAGE_READ_WITHOUT_FORMAT_BIT |
                                            VK_FORMAT_FEATURE_2_STORAGE_WRITE_WITHOUT_FORMAT_BIT;
  return (format_features(device, format) & kNeeded) == kNeeded;
}

}  // namespace kaamos::vulkan
