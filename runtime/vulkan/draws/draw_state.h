// SPDX-License-Identifier: MIT
//
// Viewports and scissor rectangles of draws, in Vulkan's terms.
#pragma once

#include <array>

#include "runtime/backend/draw_commands.h"
#include "runtime/vulkan/draws/render_pass.h"

namespace kaamos::vulkan {

struct ViewportsAndScissors {
  std::array<VkViewport, rtapi::kViewportAndScissorRectCount> viewports = {};
  std::array<VkRect2D, rtapi::kViewportAndScissorRectCount> scissors = {};
};

// All 16. Those that were not set, or are empty, have an empty scissor rectangle. [RAS-40, RAS-45]
ViewportsAndScissors viewports_and_scissors(const runtime::DrawState& state,
                                            const RenderArea& area);

// Returns the area that a draw without targets can reach: its scissor rectangles. [RAS-106]
RenderArea reach_of(const runtime::DrawState& state, const Gpu& gpu);

}  // namespace kaamos::vulkan
