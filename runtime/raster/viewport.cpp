// SPDX-License-Identifier: MIT
#include "runtime/raster/viewport.h"

#include <algorithm>
#include <cmath>

namespace kaamos::raster {
namespace {

// The first pixel whose centre is at `edge` or behind it.
int32_t first_pixel(double edge) {
  const double pixel = std::ceil(edge - 0.5);
  return static_cast<int32_t>(std::clamp(pixel, 0.0, static_cast<double>(kMaxTargetSize)));
}

bool is_finite(const rtapi::Viewport& viewport) {
  return std::isfinite(viewport.TopLeftX) && std::isfinite(viewport.TopLeftY) &&
         std::isfinite(viewport.Width) && std::isfinite(viewport.Height) &&
         std::isfinite(viewport.MinDepth) && std::isfinite(viewport.MaxDepth);
}

}  // namespace

ViewportState viewport_state(const runtime::DrawState& state, uint32_t index, uint32_t width,
                             uint32_t height) {
  ViewportState out;
  if (index >= state.viewport_count || index >= state.scissor_count) return out;
  const rtapi::Viewport& viewport = state.viewports[index];
  if (!is_finite(viewport) || !(viewport.Width > 0) || viewport.Height == 0) return out;
  out.scale_x = viewport.Width * 0.5f;
  out.offset_x = viewport.TopLeftX + out.scale_x;
  out.scale_y = viewport.Height * -0.5f;
  out.offset_y = viewport.TopLeftY - out.scale_y;
  out.scale_z = viewport.MaxDepth - viewport.MinDepth;
  out.offset_z = viewport.MinDepth;
  out.depth_low = std::min(viewport.MinDepth, viewport.MaxDepth);
  out.depth_high = std::max(viewport.MinDepth, viewport.MaxDepth);

  const double left = static_cast<double>(viewport.TopLeftX);
  const double top = static_cast<double>(viewport.TopLeftY);
  const double right = left + static_cast<double>(viewport.Width);
  const double bottom = top + static_cast<double>(viewport.Height);
  const rtapi::Rect& scissor = state.scissors[index];
  const auto target_width = static_cast<int32_t>(width);
  const auto target_height = static_cast<int32_t>(height);
  out.rect.left = std::max(first_pixel(left), scissor.left);
  out.rect.right = std::min({first_pixel(right), scissor.right, target_width});
  out.rect.top = std::max(first_pixel(std::min(top, bottom)), scissor.top);
  out.rect.bottom = std::min({first_pixel(std::max(top, bottom)), scissor.bottom, target_height});
  return out;
}

}  // namespace kaamos::raster
