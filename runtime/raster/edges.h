// SPDX-License-Identifier: MIT
//
// The three edges of a triangle as integers by pixel. E(x, y) = a x + b y + c is exact in
// subpixels; at centres of pixels it changes in multiples of 256, so E >> 8, rounded down, steps by
// a and b from pixel to pixel and has the sign of E. Edges that are not top or left have 1 taken
// off, and then a centre is covered where all three are 0 or more. [D3D11.3: 3.4.2.1]
#pragma once

#include <cstdint>
#include <cstdlib>

#include "runtime/raster/triangle.h"
#include "runtime/raster/viewport.h"

namespace kaamos::raster {

inline constexpr int32_t kTileSize = 64;

// In subpixels: triangles up to this size have values that fit in 32 bits in all blocks they touch.
inline constexpr int32_t kSmallSize = 64 * kSubpixels;

struct Edge {
  int32_t a;
  int32_t b;
  int64_t c;  // at pixel (0, 0)

  int64_t at(int32_t x, int32_t y) const {
    return static_cast<int64_t>(a) * x + static_cast<int64_t>(b) * y + c;
  }
  // The most that is added to a pixel's value within `size` pixels to the right and below.
  int64_t most(int32_t size) const {
    return static_cast<int64_t>((a > 0 ? a : 0) + (b > 0 ? b : 0)) * (size - 1);
  }
  int64_t least(int32_t size) const {
    return static_cast<int64_t>((a < 0 ? a : 0) + (b < 0 ? b : 0)) * (size - 1);
  }
};

// Whether a line with these differences goes through more columns of pixels than rows, or as many.
inline bool is_along_x(int64_t dx, int64_t dy) {
  return std::abs(dx) >= std::abs(dy);
}

// From vertex i to the next one.
inline Edge edge_of(const Triangle& t, int i) {
  const int j = i == 2 ? 0 : i + 1;
  Edge edge;
  edge.a = t.y[i] - t.y[j];
  edge.b = t.x[j] - t.x[i];
  const bool top_left = edge.a > 0 || (edge.a == 0 && edge.b > 0);
  const int64_t c =
      -(static_cast<int64_t>(edge.a) * t.x[i] + static_cast<int64_t>(edge.b) * t.y[i]);
  edge.c = (c + static_cast<int64_t>(kPixelCenter) * (edge.a + edge.b) - (top_left ? 0 : 1)) >>
           kSubpixelBits;
  return edge;
}

// Two edges half a pixel to either side of a line, in the direction that it changes less in: of
// each column of pixels, or row, there is one centre between them. Triangle::box holds its ends,
// and so there is no third edge. [D3D11.3: 3.4.3.1]
inline void edges_of_line(const Triangle& t, Edge edges[3]) {
  const int64_t dx = t.x[1] - t.x[0], dy = t.y[1] - t.y[0];
  const bool along_x = is_along_x(dx, dy);
  const bool forward = along_x ? dx > 0 : dy > 0;
  const int64_t sign = (along_x == forward) ? 1 : -1;
  // Positive below a line along x, and to the right of one along y.
  const auto a = static_cast<int32_t>(-dy * sign), b = static_cast<int32_t>(dx * sign);
  const int64_t c = -(static_cast<int64_t>(a) * t.x[0] + static_cast<int64_t>(b) * t.y[0]);
  const int64_t half = kPixelCenter * (along_x ? std::abs(dx) : std::abs(dy));
  const int64_t to_centre = static_cast<int64_t>(kPixelCenter) * (int64_t{a} + b);
  edges[0] = {a, b, (c + half + to_centre) >> kSubpixelBits};
  edges[1] = {-a, -b, (-c + half - to_centre - 1) >> kSubpixelBits};
  edges[2] = {0, 0, 0};
}

inline void edges_of(const Triangle& t, Edge edges[3]) {
  if ((t.flags & kLine) != 0) return edges_of_line(t, edges);
  for (int i = 0; i < 3; ++i) edges[i] = edge_of(t, i);
}

}  // namespace kaamos::raster
