// SPDX-License-Identifier: MIT
//
// Values of ClearRenderTargetView and ClearDepthStencilView as Vulkan takes them.
#pragma once

#include <volk.h>

#include "runtime/backend/draw_commands.h"

namespace kaamos::vulkan {

// The colour in the format: integers are converted here, because drivers differ. [RAS-135]
VkClearColorValue clear_color(rtapi::Format format, const float color[4]);
// Depth such that the driver's conversion gives the nearest step. [RAS-136]
VkClearDepthStencilValue clear_depth(const runtime::ClearTargetCommand& command);

}  // namespace kaamos::vulkan
