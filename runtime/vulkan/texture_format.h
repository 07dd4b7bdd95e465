// SPDX-License-Identifier: MIT
//
// Vulkan's formats for textures.
#pragma once

#include <volk.h>

#include <cstdint>

#include <rtapi/format.h>

namespace kaamos::vulkan {

struct TextureFormat {
  VkFormat format = VK_FORMAT_UNDEFINED;  // UNDEFINED: textures cannot have it
  // Where to find the channels of the DXGI format.
  VkComponentMapping channels = {VK_COMPONENT_SWIZZLE_R, VK_COMPONENT_SWIZZLE_G,
                                 VK_COMPONENT_SWIZZLE_B, VK_COMPONENT_SWIZZLE_A};
  bool plain = true;  // channels are in Vulkan's own places, which storage images need
};

// A typeless format gives a member of its family, for images whose views have their own formats.
TextureFormat texture_format(rtapi::Format format);

}  // namespace kaamos::vulkan
