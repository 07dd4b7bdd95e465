// SPDX-License-Identifier: MIT
//
// Triangles on the screen, ready to be drawn, and the batches they come in.
#pragma once

#include <cstdint>

#include "runtime/backend/draw_observation.h"
#include "runtime/raster/storage.h"

namespace kaamos::raster {

// A vertex on the screen.
struct ScreenVertex {
  int32_t x;  // snapped
  int32_t y;
  float z;      // after the viewport
  float inv_w;  // 1 / w
};

enum TriangleFlags : uint32_t {
  kFrontFacing = 1,
  kSwapped = 2,  // its vertices are 0, 2, 1 of the primitive
  kClipped = 4,  // part of a primitive: `clip` is valid
  kSliver = 8,   // so long and thin that its plane of depth is not exact enough
  kSmall = 16,   // edges fit in 32 bits without regard to tiles
  kMasked = 32,  // blocks that it reaches hold pixels that may not be drawn
  kCulled = 64,  // by facing; only where DrawPlan::keeps_culled
  kLine = 128,   // covers the pixels along the line from vertex 0 to vertex 1
  kViewportShift = 8,
};

// Pixels [left, right) x [top, bottom) of a target.
struct PixelBox {
  int16_t left, top, right, bottom;
};

// The part of a triangle that its coverage and depth need, in one line of the cache. Its vertices
// are clockwise, y down. Vertex 0 is the leading one unless it is clipped. Of a line (kLine),
// vertex 2 makes the plane in which depth and attributes change along the line alone.
struct alignas(64) Triangle {
  int32_t x[3];
  int32_t y[3];
  float z[3];      // with the depth bias
  uint32_t flags;  // TriangleFlags, and the viewport's number << kViewportShift
  PixelBox box;    // what it reaches of what may be drawn
  double dz_dx;    // by subpixel
  double dz_dy;
};
static_assert(sizeof(Triangle) == 64);

// The rest of a triangle, which its pixels need.
struct TriangleShading {
  uint32_t vertex[3];  // of the batch; if it is clipped those of the primitive, in its order
  uint32_t primitive_id;
  float inv_w[3];  // in the order of Triangle::x
  uint32_t clip;   // number of its ClipWeights
};

// Weights of the primitive's vertices, by vertex, that make up a clipped triangle's vertices.
struct ClipWeights {
  float perspective[3][3];  // in clip space
  float screen[3][3];       // on the screen, for what is linear there
};

// Triangles of a batch in one tile.
struct TileRun {
  uint32_t tile;
  uint32_t first;  // in Batch::triangles
  uint32_t count;
};

// Triangles and lines of one instance of a draw that are set up together.
struct Batch {
  uint32_t draw = 0;
  uint32_t plan = 0;
  uint32_t instance = 0;
  runtime::DrawCounts counts;        // of its vertices and triangles, where DrawPlan::observed
  Storage<uint32_t> rows;            // what pixels need of each vertex, by DrawPlan
  Storage<Triangle> triangles;       // of all runs, in the order of drawing in each
  Storage<uint32_t> numbers;         // theirs in the batch, where DrawPlan::has_shading
  Storage<TriangleShading> shading;  // by number in the batch
  Storage<ClipWeights> clips;
  Storage<TileRun> runs;

  void clear() {
    rows.clear();
    triangles.clear();
    numbers.clear();
    shading.clear();
    clips.clear();
    runs.clear();
  }
  size_t bytes() const {
    return rows.bytes() + triangles.bytes() + numbers.bytes() + shading.bytes() + clips.bytes() +
           runs.bytes();
  }
};

}  // namespace kaamos::raster
