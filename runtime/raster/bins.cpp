// SPDX-License-Identifier: MIT
#include "runtime/raster/bins.h"

#include <algorithm>
#include <cstdlib>

namespace kaamos::raster {

void Bins::begin(const TileGrid& grid, bool multisampled) {
  multisampled_ = multisampled;
  columns_ = grid.columns;
  rows_ = grid.rows;
  // A batch before this one may have been left in the middle.
  for (const uint32_t tile : touched_) counts_[tile] = 0;
  const size_t known = counts_.size();
  if (known < grid.count()) {
    counts_.resize(grid.count());
    std::fill(counts_.begin() + known, counts_.end(), 0u);
  }
  entries_.clear();
  touched_.clear();
}

void Bins::add_large(const Triangle& triangle, uint32_t left, uint32_t right, uint32_t top,
                     uint32_t bottom, uint32_t first, uint32_t number) {
  Edge edges[3];
  int64_t most[3];
  edges_of(triangle, edges);
  for (int i = 0; i < 3; ++i) {
    most[i] = edges[i].most(kTileSize);
    // Samples are up to half a pixel from the middle.
    if (multisampled_) most[i] += (std::abs(edges[i].a) + std::abs(edges[i].b)) / 2 + 1;
  }
  for (uint32_t row = top; row <= bottom; ++row) {
    const auto y = static_cast<int32_t>(row) * kTileSize;
    for (uint32_t column = left; column <= right; ++column) {
      const auto x = static_cast<int32_t>(column) * kTileSize;
      bool outside = false;
      for (int i = 0; i < 3; ++i) outside = outside || edges[i].at(x, y) + most[i] < 0;
      if (!outside) put(first + (row - top) * columns_ + column, number);
    }
  }
}

void Bins::finish(const Triangle* triangles, bool wants_numbers, Batch& batch) {
  std::sort(touched_.begin(), touched_.end());
  batch.runs.resize(touched_.size());
  batch.triangles.resize(entries_.size());
  if (wants_numbers) batch.numbers.resize(entries_.size());
  uint32_t first = 0;
  for (size_t i = 0; i < touched_.size(); ++i) {
    const uint32_t tile = touched_[i];
    const uint32_t count = counts_[tile];
    batch.runs[i] = {tile, first, count};
    counts_[tile] = first;  // where its next triangle goes
    first += count;
  }
  for (const Entry& entry : entries_) {
    const uint32_t at = counts_[entry.tile]++;
    batch.triangles[at] = triangles[entry.triangle];
    if (wants_numbers) batch.numbers[at] = entry.triangle;
  }
  for (const uint32_t tile : touched_) counts_[tile] = 0;
  touched_.clear();
}

}  // namespace kaamos::raster
