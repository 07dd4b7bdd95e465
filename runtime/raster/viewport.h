// SPDX-License-Identifier: MIT
//
// From clip space to pixels. [D3D11.3: 3.3.1, 15.6]
#pragma once

#include <cstdint>

#include "runtime/backend/draw_commands.h"

namespace kaamos::raster {

// Positions on the screen have 8 fractional bits.
inline constexpr int kSubpixelBits = 8;
inline constexpr int32_t kSubpixels = 1 << kSubpixelBits;
inline constexpr int32_t kPixelCenter = kSubpixels / 2;

// Triangles are cut at these pixel coordinates if they reach beyond, so that differences of snapped
// coordinates have 24 bits. Any target lies within. They do not depend on anything, because where
// a triangle is cut changes rounding.
inline constexpr float kGuardLow = -8192;
inline constexpr float kGuardHigh = 24576;
inline constexpr int32_t kMaxTargetSize = 16384;

// Least w that is in front of the eye: denormals count as 0.
inline constexpr float kLeastW = 0x1p-126f;

// Pixels [left, right) x [top, bottom).
struct PixelRect {
  int32_t left = 0;
  int32_t top = 0;
  int32_t right = 0;
  int32_t bottom = 0;

  bool empty() const { return left >= right || top >= bottom; }
};

// X = x/w * scale_x + offset_x, and so on.
struct ViewportState {
  float scale_x = 0, offset_x = 0;
  float scale_y = 0, offset_y = 0;
  float scale_z = 0, offset_z = 0;
  float depth_low = 0;  // of depths that are tested and written
  float depth_high = 0;
  PixelRect rect;  // what may be drawn: viewport, scissor and target in common
};

// Viewport and scissor number `index` on a target of `width` x `height`; an empty rectangle if
// one of them was not set or nothing can be drawn.
ViewportState viewport_state(const runtime::DrawState& state, uint32_t index, uint32_t width,
                             uint32_t height);

}  // namespace kaamos::raster
