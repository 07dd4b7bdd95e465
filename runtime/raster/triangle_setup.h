// SPDX-License-Identifier: MIT
//
// Computes what is needed once for each triangle: facing, depth bias, the plane of depth.
// [D3D11.3: 15.10, 15.11, 15.16]
#pragma once

#include "runtime/raster/draw_plan.h"
#include "runtime/raster/triangle.h"

namespace kaamos::raster {

enum class SetUp : uint8_t { kDone, kZeroArea, kCulled, kNoPixel };

// kNoPixel if the triangle holds no centre of a pixel of `rect`. kDone: the position, the depth and
// the flags but kClipped and the viewport's number are filled in.
SetUp set_up_triangle(const DrawPlan& plan, const PixelRect& rect, const ScreenVertex vertices[3],
                      Triangle& out);

}  // namespace kaamos::raster
