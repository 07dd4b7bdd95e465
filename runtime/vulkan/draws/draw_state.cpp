// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/draw_state.h"

#include <algorithm>
#include <cmath>

namespace kaamos::vulkan {
namespace {

constexpr int32_t kMostPixels = 16384;

// The first pixel whose centre is at `edge` or behind it.
int32_t pixel_behind(double edge) {
  const double pixel = std::ceil(edge - 0.5);
  return static_cast<int32_t>(std::clamp(pixel, 0.0, static_cast<double>(kMostPixels)));
}

// Not empty.
bool draws_something(const rtapi::Viewport& viewport) {
  return viewport.Width > 0 && viewport.Height != 0;
}

// A primitive is limited to the viewport's rectangle, and depends on its scissor rectangle.
// [RAS-39, RAS-41]
VkRect2D scissor_of(const rtapi::Viewport& viewport, const rtapi::Rect& scissor,
                    const RenderArea& area) {
  const auto left = static_cast<double>(viewport.TopLeftX);
  const auto right = left + static_cast<double>(viewport.Width);
  const auto top = static_cast<double>(viewport.TopLeftY);
  const auto bottom = top + static_cast<double>(viewport.Height);
  const int32_t x0 = std::max(pixel_behind(left), scissor.left);
  const int32_t y0 = std::max(pixel_behind(std::min(top, bottom)), scissor.top);
  const int32_t x1 =
      std::min({pixel_behind(right), scissor.right, static_cast<int32_t>(area.width)});
  const int32_t y1 = std::min(
      {pixel_behind(std::max(top, bottom)), scissor.bottom, static_cast<int32_t>(area.height)});
  if (x1 <= x0 || y1 <= y0) return {};
  return {{x0, y0}, {static_cast<uint32_t>(x1 - x0), static_cast<uint32_t>(y1 - y0)}};
}

}  // namespace

ViewportsAndScissors viewports_and_scissors(const runtime::DrawState& state,
                                            const RenderArea& area) {
  ViewportsAndScissors result;
  for (uint32_t i = 0; i < result.viewports.size(); ++i) {
    result.viewports[i] = {0, 0, 1, 1, 0, 1};
    if (i >= state.viewport_count || i >= state.scissor_count) continue;
    const rtapi::Viewport& viewport = state.viewports[i];
    if (!draws_something(viewport)) continue;
    // Y points down in D3D, and up in Vulkan's clip space after a flip of the viewport. [RAS-37]
    result.viewports[i] = {viewport.TopLeftX, viewport.TopLeftY + viewport.Height,
                           viewport.Width,    -viewport.Height,
                           viewport.MinDepth, viewport.MaxDepth};
    result.scissors[i] = scissor_of(viewport, state.scissors[i], area);
  }
  return result;
}

RenderArea reach_of(const runtime::DrawState& state, const Gpu& gpu) {
  const VkPhysicalDeviceLimits& limits = gpu.properties().core.limits;
  const RenderArea most = {limits.maxFramebufferWidth, limits.maxFramebufferHeight, 1};
  const ViewportsAndScissors all = viewports_and_scissors(state, most);
  RenderArea area = {1, 1, 1};
  for (const VkRect2D& rect : all.scissors) {
    area.width = std::max(area.width, static_cast<uint32_t>(rect.offset.x) + rect.extent.width);
    area.height = std::max(area.height, static_cast<uint32_t>(rect.offset.y) + rect.extent.height);
  }
  return area;
}

}  // namespace kaamos::vulkan
