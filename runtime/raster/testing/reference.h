// SPDX-License-Identifier: MIT
//
// Computes what the rasterizer must compute, pixel by pixel and as the rules are written: 64-bit
// integers, no tiles, no clipping. For triangles in front of the eye that do not reach beyond the
// guard band.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/backend/draw_commands.h"

namespace kaamos::raster::testing {

class ReferenceTriangle {
 public:
  // Corners in clip space.
  ReferenceTriangle(const float corners[3][4], const rtapi::Viewport& viewport);

  // Returns whether the centre of a pixel is inside, or on a top or left edge.
  bool covers(int32_t x, int32_t y) const;
  // z at the centre, from the snapped corners.
  long double depth(int32_t x, int32_t y) const;
  // Weights of the corners there: on the screen, or perspective correct.
  void weights(int32_t x, int32_t y, bool perspective, long double out[3]) const;

 private:
  int64_t edge(int from, int64_t x, int64_t y) const;

  int64_t x_[3], y_[3];  // subpixels
  float z_[3], w_[3];
  int64_t area_;
};

}  // namespace kaamos::raster::testing
