// SPDX-License-Identifier: MIT
//
// Finds the pixels of a tile that a triangle covers, block by block of 4 x 2 pixels, in 32-bit
// integers: an edge that crosses the tile has values that fit, and one that does not needs no test.
#pragma once

#include "runtime/raster/edges.h"
#include "runtime/raster/lanes.h"
#include "runtime/raster/triangle_setup.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

// Pixels of a block in the order of pixel shaders.
inline constexpr int32_t kBlockX[8] = {0, 1, 0, 1, 2, 3, 2, 3};
inline constexpr int32_t kBlockY[8] = {0, 0, 1, 1, 0, 0, 1, 1};

class Coverage {
 public:
  // The triangle in the tile whose first pixel is (x, y); only pixels of `rect` count. False if it
  // covers nothing there.
  KAAMOS_INLINE bool begin(const Triangle& triangle, const PixelRect& rect, int32_t x, int32_t y) {
    const PixelBox& box = triangle.box;
    first_block_x_ = box.left > x ? (box.left - x) >> 2 : 0;
    first_block_y_ = box.top > y ? (box.top - y) >> 1 : 0;
    last_block_x_ = (box.right < x + kTileSize ? box.right - 1 - x : kTileSize - 1) >> 2;
    last_block_y_ = (box.bottom < y + kTileSize ? box.bottom - 1 - y : kTileSize - 1) >> 1;
    masked_ = (triangle.flags & kMasked) != 0;
    if (masked_) rect_ = {rect.left - x, rect.top - y, rect.right - x, rect.bottom - y};
    if ((triangle.flags & kSmall) != 0) {
      begin_small(triangle, x, y);
      return true;
    }
    if ((triangle.flags & kLine) != 0) {
      rect_ = {box.left - x, box.top - y, box.right - x, box.bottom - y};
    }
    Edge edges[3];
    edges_of(triangle, edges);
    for (int i = 0; i < 3; ++i) {
      const Edge& edge = edges[i];
      const int64_t corner = edge.at(x, y);
      if (corner + edge.most(kTileSize) < 0) return false;
      if (corner + edge.least(kTileSize) >= 0) {
        a_[i] = b_[i] = e_[i] = 0;
        continue;
      }
      a_[i] = edge.a;
      b_[i] = edge.b;
      e_[i] = static_cast<int32_t>(corner);
    }
    return true;
  }

  // Calls sink.row(block y) for rows of blocks, top to bottom, and for each sink.block(block x,
  // block y, covered) for those that have covered pixels.
  template <class Sink>
  KAAMOS_INLINE void each_block(Sink& sink) const {
    Ints8 in_block[3];
    for (int i = 0; i < 3; ++i) {
      in_block[i] = splat(a_[i]) * load<int32_t>(kBlockX) + splat(b_[i]) * load<int32_t>(kBlockY);
    }
    // A cell is 2 x 4 blocks: 8 x 8 pixels.
    const bool large = last_block_x_ - first_block_x_ >= 4 || last_block_y_ - first_block_y_ >= 8;
    if (!large) {
      rows(first_block_x_, last_block_x_, first_block_y_, last_block_y_, in_block, sink);
      return;
    }
    for (int32_t cell_y = first_block_y_ & ~3; cell_y <= last_block_y_; cell_y += 4) {
      for (int32_t cell_x = first_block_x_ & ~1; cell_x <= last_block_x_; cell_x += 2) {
        bool outside = false;
        for (int i = 0; i < 3; ++i) {
          const int32_t corner = e_[i] + a_[i] * cell_x * 4 + b_[i] * cell_y * 2;
          const int32_t most = ((a_[i] > 0 ? a_[i] : 0) + (b_[i] > 0 ? b_[i] : 0)) * 7;
          outside |= corner + most < 0;
        }
        if (outside) continue;
        rows(cell_x > first_block_x_ ? cell_x : first_block_x_,
             cell_x + 1 < last_block_x_ ? cell_x + 1 : last_block_x_,
             cell_y > first_block_y_ ? cell_y : first_block_y_,
             cell_y + 3 < last_block_y_ ? cell_y + 3 : last_block_y_, in_block, sink);
      }
    }
  }

 private:
  // edge_of() of all three edges, and their values at the tile's first pixel. The fourth lane is
  // of no use.
  KAAMOS_INLINE void begin_small(const Triangle& t, int32_t x, int32_t y) {
    const auto next = [](IntQuarter v) { return __builtin_shufflevector(v, v, 1, 2, 0, 0); };
    const IntQuarter vx = {t.x[0], t.x[1], t.x[2], t.x[0]};
    const IntQuarter vy = {t.y[0], t.y[1], t.y[2], t.y[0]};
    const IntQuarter a = vy - next(vy);
    const IntQuarter b = next(vx) - vx;
    const IntQuarter from_x = IntQuarter{} + (x * kSubpixels + kPixelCenter) - vx;
    const IntQuarter from_y = IntQuarter{} + (y * kSubpixels + kPixelCenter) - vy;
    const IntQuarter top_left = (a > 0) | ((a == 0) & (b > 0));
    const IntQuarter e = (a * from_x + b * from_y - 1 - top_left) >> kSubpixelBits;
    __builtin_memcpy(a_, &a, sizeof(a_));
    __builtin_memcpy(b_, &b, sizeof(b_));
    __builtin_memcpy(e_, &e, sizeof(e_));
  }

  template <class Sink>
  KAAMOS_INLINE void rows(int32_t left, int32_t right, int32_t top, int32_t bottom,
                          const Ints8 in_block[3], Sink& sink) const {
    Ints8 row[3], to_right[3], down[3];
    for (int i = 0; i < 3; ++i) {
      row[i] = splat(e_[i] + a_[i] * left * 4 + b_[i] * top * 2) + in_block[i];
      to_right[i] = splat(a_[i] * 4);
      down[i] = splat(b_[i] * 2);
    }
    for (int32_t y = top; y <= bottom; ++y) {
      Ints8 e[3] = {row[0], row[1], row[2]};
      for (int i = 0; i < 3; ++i) row[i] = row[i] + down[i];
      sink.row(y);
      for (int32_t x = left; x <= right; ++x) {
        lanes covered = not_negative(e[0] | e[1] | e[2]);
        for (int i = 0; i < 3; ++i) e[i] = e[i] + to_right[i];
        if (masked_) covered = covered & lanes_of(rect_bits(x, y));
        if (shader::any_lane(covered)) sink.block(x, y, covered);
      }
    }
  }

  // The block's pixels that are in the rectangle.
  uint32_t rect_bits(int32_t block_x, int32_t block_y) const {
    constexpr uint32_t kColumns[4] = {0x05, 0x0A, 0x50, 0xA0};
    constexpr uint32_t kRows[2] = {0x33, 0xCC};
    uint32_t columns = 0;
    uint32_t rows = 0;
    for (int32_t i = 0; i < 4; ++i) {
      const int32_t x = block_x * 4 + i;
      if (x >= rect_.left && x < rect_.right) columns |= kColumns[i];
    }
    for (int32_t i = 0; i < 2; ++i) {
      const int32_t y = block_y * 2 + i;
      if (y >= rect_.top && y < rect_.bottom) rows |= kRows[i];
    }
    return columns & rows;
  }

  int32_t a_[4], b_[4], e_[4];  // of three edges
  int32_t first_block_x_, last_block_x_, first_block_y_, last_block_y_;
  PixelRect rect_;  // in the tile
  bool masked_;
};

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
