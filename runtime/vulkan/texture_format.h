// SPDX-License-Identifier: MIT
//
// Formats of textures as Vulkan has them.
#pragma once

#include <volk.h>

#include <cstdint>

#include <rtapi/format.h>

namespace kaamos::vulkan {

struct TextureFormat {
  VkFormat format = VK_FORMAT_UNDEFINED;  // UNDEFINED: textures cannot have it
  // Where the channels of the DXGI format are found.
  VkComponentMapping channels = {VK_COMPONENT_SWIZZLE_R, VK_COMPONENT_SWIZZLE_G,
                                 VK_COMPONENT_SWIZZLE_B, VK_COMPONENT_SWIZZLE_A};
  bool plain = true;  // channels are where Vulkan has them: storage images need that
};

// Typeless formats are a member of their family, for images whose views have formats of their own.
TextureFormat texture_format(rtapi::Format format);

}  // namespace kaamos::vulkan
