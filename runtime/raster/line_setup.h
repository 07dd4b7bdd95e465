// SPDX-License-Identifier: MIT
//
// Computes what is needed once for each line: the pixels at its ends, the plane in which depth and
// attributes change along it, and the rectangle that stands for it where lines are multisampled.
// [D3D11.3: 3.4.3]
#pragma once

#include "runtime/raster/triangle_setup.h"

namespace kaamos::raster {

// The line from vertex 0 to vertex 1, one pixel of each column or row, without the pixel whose
// diamond it ends in. kNoPixel if there is none in `rect`. kDone: as of set_up_triangle; the third
// vertex is as deep as the first, and facing is left to the caller.
SetUp set_up_line(const PixelRect& rect, const ScreenVertex ends[2], Triangle& out);

// The corners of a rectangle 1.4 pixels wide around the line: both at its start, both at its end.
void line_rectangle(const ScreenVertex ends[2], ScreenVertex corners[4]);

// The corners of a square of one pixel around a point, two and two.
void point_square(const ScreenVertex& point, ScreenVertex corners[4]);

}  // namespace kaamos::raster
