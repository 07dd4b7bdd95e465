// SPDX-License-Identifier: MIT
//
// Cuts lines and triangles at the borders of what can be seen. [D3D11.3: 15.4]
#pragma once

#include <cstdint>

#include "runtime/raster/viewport.h"

namespace kaamos::raster {

inline constexpr int kMaxClipDistances = 8;
// Three vertices, and one more for each of 7 planes and 8 distances.
inline constexpr int kMaxClippedVertices = 3 + 7 + kMaxClipDistances;

// In double, so that a cut edge stays within a fraction of a subpixel of the whole one.
struct ClipVertex {
  double x, y, z, w;
  double weight[3];  // of the primitive's vertices
  double distance[kMaxClipDistances];
};

struct ClipPlanes {
  bool depth = true;            // 0 <= z <= w
  uint32_t distances = 0;       // number of clip distances
  uint32_t used_distances = 0;  // a bit for each that is negative somewhere
};

// The part of a primitive inside of all planes: w > 0, the depth range if it clips, clip distances
// that are 0 or more, the guard band. `polygon` holds the vertices of a triangle (corners: 3) or a
// line (2), and then the result, in the same order of rotation or direction. Returns the number of
// vertices, 0 if nothing is left.
//
// New vertices on an edge do not depend on which triangle the edge belongs to, nor on its
// direction.
int clip(const ClipPlanes& planes, const ViewportState& viewport, int corners,
         ClipVertex polygon[kMaxClippedVertices]);

}  // namespace kaamos::raster
