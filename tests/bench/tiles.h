// SPDX-License-Identifier: MIT
#pragma once

#include <immintrin.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>

namespace kaamos::bench {

// Calls cell(y * width + x) for each cell of a grid in tiles of 16 x 16 on the arena's threads,
// with denormals flushed. make_cell() gives a cell function for one run of tiles.
template <typename MakeCell>
void for_each_cell(tbb::task_arena& arena, uint32_t width, uint32_t height, MakeCell make_cell) {
  constexpr uint32_t kEdge = 16;
  const uint32_t columns = (width + kEdge - 1) / kEdge;
  const uint32_t rows = (height + kEdge - 1) / kEdge;
  const auto run = [&](const tbb::blocked_range<uint32_t>& tiles) {
    const uint32_t saved = _mm_getcsr();
    _mm_setcsr(saved | 0x8040);  // flush to zero, denormals are zero
    auto cell = make_cell();
    for (uint32_t tile = tiles.begin(); tile < tiles.end(); ++tile) {
      const uint32_t left = tile % columns * kEdge;
      const uint32_t top = tile / columns * kEdge;
      const uint32_t right = std::min(width, left + kEdge);
      const uint32_t bottom = std::min(height, top + kEdge);
      for (uint32_t y = top; y < bottom; ++y) {
        for (uint32_t x = left; x < right; ++x) cell(y * width + x);
      }
    }
    _mm_setcsr(saved);
  };
  arena.execute([&] { tbb::parallel_for(tbb::blocked_range<uint32_t>(0, columns * rows), run); });
}

}  // namespace kaamos::bench
