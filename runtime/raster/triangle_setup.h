// SPDX-License-Identifier: MIT
//
// What is computed once for each triangle: facing, depth bias, the plane of depth.
// [D3D11.3: 15.10, 15.11, 15.16]
#pragma once

#include "runtime/raster/draw_plan.h"
#include "runtime/raster/triangle.h"

namespace kaamos::raster {

// False if the triangle has no area, is culled, or holds no centre of a pixel of `rect`; else fills
// in the position, the depth and the flags but kClipped and the viewport's number.
bool set_up_triangle(const DrawPlan& plan, const PixelRect& rect, const ScreenVertex vertices[3],
                     Triangle& out);

}  // namespace kaamos::raster
