// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "runtime/embree/parallel.h"
#include "runtime/shader/float_mode.h"

namespace kaamos::bench {

// Calls cell(y * width + x) for each cell of a grid, in tiles of 16 x 16 on the arena's threads,
// with denormals flushed. make_cell() returns a cell function for one run of tiles.
template <typename MakeCell>
void for_each_cell(tbb::task_arena& arena, uint32_t width, uint32_t height, MakeCell make_cell) {
  constexpr uint32_t kEdge = 16;
  const uint32_t columns = (width + kEdge - 1) / kEdge;
  const uint32_t rows = (height + kEdge - 1) / kEdge;
  embree::parallel_ranges(arena, uint64_t{columns} * rows, [&](uint64_t begin, uint64_t end) {
    const shader::FloatMode float_mode;
    auto cell = make_cell();
    for (auto tile = static_cast<uint32_t>(begin); tile < end; ++tile) {
      const uint32_t left = tile % columns * kEdge;
      const uint32_t top = tile / columns * kEdge;
      const uint32_t right = std::min(width, left + kEdge);
      const uint32_t bottom = std::min(height, top + kEdge);
      for (uint32_t y = top; y < bottom; ++y) {
        for (uint32_t x = left; x < right; ++x) cell(y * width + x);
      }
    }
  });
}

}  // namespace kaamos::bench
