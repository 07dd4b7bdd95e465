// SPDX-License-Identifier: MIT
//
// Vulkan's formats for textures.
#pragma once

#include <volk.h>

#include <cstdint>

#include <rtapi/format.h>
#include <rtapi/resource.h>

namespace kaamos::vulkan {

struct TextureFormat {
  VkFormat format = VK_FORMAT_UNDEFINED;  // UNDEFINED: textures cannot have it
  // The places where the channels of the DXGI format are found.
  VkComponentMapping channels = {VK_COMPONENT_SWIZZLE_R, VK_COMPONENT_SWIZZLE_G,
                                 VK_COMPONENT_SWIZZLE_B, VK_COMPONENT_SWIZZLE_A};
  bool plain = true;  // channels are in Vulkan's own places, which storage images and targets need
  VkImageAspectFlags aspects = VK_IMAGE_ASPECT_COLOR_BIT;  // what it shows of an image
};

// A typeless format gives a member of its family, for images whose views have their own formats.
// Formats that have depth or stencil in their names give depth images.
TextureFormat texture_format(rtapi::Format format);
// The same for a view of a depth image, where R32_FLOAT and R16_UNORM are depth, too.
TextureFormat depth_view_format(rtapi::Format format);
// Returns the format of an image: a depth format if it can be a depth-stencil target.
TextureFormat image_format(const rtapi::TextureDesc& desc);

VkFormatFeatureFlags2 format_features(VkPhysicalDevice device, VkFormat format);
// Returns whether shaders can read and write images in the format without naming it.
bool can_be_storage(VkPhysicalDevice device, VkFormat format);

}  // namespace kaamos::vulkan
