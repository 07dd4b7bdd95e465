// SPDX-License-Identifier: MIT
//
// Computes what is needed once for each triangle: facing, depth bias, the plane of depth.
// [D3D11.3: 15.10, 15.11, 15.16]
#pragma once

#include <algorithm>

#include "runtime/raster/draw_plan.h"
#include "runtime/raster/triangle.h"

namespace kaamos::raster {

enum class SetUp : uint8_t { kDone, kZeroArea, kCulled, kNoPixel };

// What a triangle is a part of. Those of points and lines are front facing, whichever way they
// turn, and neither culled nor biased.
enum class PartOf : uint8_t { kTriangle, kPointOrLine };

// The part of `reach` in `rect` becomes the triangle's box; returns it.
inline PixelRect set_box(const PixelRect& rect, const PixelRect& reach, Triangle& triangle) {
  const PixelRect box{std::max(rect.left, reach.left), std::max(rect.top, reach.top),
                      std::min(rect.right, reach.right), std::min(rect.bottom, reach.bottom)};
  triangle.box = {static_cast<int16_t>(box.left), static_cast<int16_t>(box.top),
                  static_cast<int16_t>(box.right), static_cast<int16_t>(box.bottom)};
  return box;
}

// Depths at a triangle's vertices, and a plane through them, by subpixel. `area` is not 0.
void set_depth_plane(Triangle& triangle, double area);

// Which way a triangle faces, and the depth bias of its edges.
struct Orientation {
  bool front = true;
  float bias = 0;
};

// kDone, kZeroArea or kCulled.
SetUp orient_triangle(const DrawPlan& plan, const ScreenVertex vertices[3], Orientation& out);

// kNoPixel if the triangle holds no centre of a pixel of `rect`. kDone: the position, the depth and
// the flags but kClipped and the viewport's number are filled in.
SetUp set_up_triangle(const DrawPlan& plan, const PixelRect& rect, const ScreenVertex vertices[3],
                      Triangle& out, PartOf part_of = PartOf::kTriangle);

}  // namespace kaamos::raster
