// SPDX-License-Identifier: MIT
//
// Finds the tiles that the triangles of a batch reach.
#pragma once

#include <cstdint>

#include "runtime/raster/edges.h"
#include "runtime/raster/triangle.h"
#include "runtime/raster/viewport.h"

namespace kaamos::raster {

// The tiles of all slices of a pass, row by row, slice by slice.
struct TileGrid {
  uint32_t columns = 0;
  uint32_t rows = 0;
  uint32_t slices = 1;

  uint32_t count() const { return columns * rows * slices; }
};

// Collects the tiles of a batch's triangles, then sorts them.
class Bins {
 public:
  // `multisampled`: pixels are reached where any part of them is.
  void begin(const TileGrid& grid, bool multisampled = false);
  void add(const Triangle& triangle, uint32_t slice, uint32_t number) {
    const PixelBox& box = triangle.box;
    const auto left = static_cast<uint32_t>(box.left) / kTileSize;
    const auto right = static_cast<uint32_t>(box.right - 1) / kTileSize;
    const auto top = static_cast<uint32_t>(box.top) / kTileSize;
    const auto bottom = static_cast<uint32_t>(box.bottom - 1) / kTileSize;
    const uint32_t first = (slice * rows_ + top) * columns_;
    if (left == right && top == bottom) {
      put(first + left, number);
    } else {
      add_large(triangle, left, right, top, bottom, first, number);
    }
  }
  // Fills in `runs`, `triangles` and, if wanted, `numbers`. The triangles are copied, so that a
  // tile finds its own side by side.
  void finish(const Triangle* triangles, bool wants_numbers, Batch& batch);

 private:
  struct Entry {
    uint32_t tile;
    uint32_t triangle;
  };

  void add_large(const Triangle& triangle, uint32_t left, uint32_t right, uint32_t top,
                 uint32_t bottom, uint32_t first, uint32_t number);
  void put(uint32_t tile, uint32_t number) {
    entries_.push_back({tile, number});
    if (counts_[tile]++ == 0) touched_.push_back(tile);
  }

  bool multisampled_ = false;
  uint32_t columns_ = 0;
  uint32_t rows_ = 0;
  Storage<Entry> entries_;
  Storage<uint32_t> counts_;  // by tile; all 0 between batches
  Storage<uint32_t> touched_;
};

}  // namespace kaamos::raster
