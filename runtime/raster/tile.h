// SPDX-License-Identifier: MIT
//
// A tile of the targets while its triangles are drawn: depth, stencil and colours are in buffers of
// its own, in the order of pixel shaders.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>

#include "runtime/raster/draw_plan.h"
#include "runtime/raster/edges.h"
#include "runtime/raster/tile_colors.h"
#include "runtime/raster/triangle.h"
#include "runtime/raster/workers.h"

namespace kaamos::raster {

inline constexpr uint32_t kTilePixels = kTileSize * kTileSize;
inline constexpr uint32_t kQuadsPerRow = kTileSize / 2;

// Four words for each quad, row by row of quads; two quads side by side are a block.
struct alignas(64) TileDepth {
  uint32_t words[kTilePixels];

  void fill(uint32_t word) { std::fill(words, words + kTilePixels, word); }
  // From and to a slice of the target, whose pixel (x, y) is the tile's first. What is beyond the
  // target is left alone.
  void load(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice);
  void store(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice) const;
};

// The same with a byte for each pixel, of formats that have stencil.
struct alignas(64) TileStencil {
  uint8_t bytes[kTilePixels];

  void load(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice);
  void store(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice) const;
};

// Quads of one triangle that wait for the pixel shader.
struct QuadQueue {
  static constexpr uint32_t kCapacity = 64;
  uint32_t count = 0;
  uint16_t quad[kCapacity];  // number in the tile
  uint8_t covered[kCapacity];
  alignas(32) float z[kCapacity * 4];
};

class TileObserver;
struct Observation;
struct MultisampleScratch;  // multisample_scratch.h

// Memory of one thread.
struct TileScratch {
  TileDepth depth;
  TileStencil stencil;  // only where a draw tests it
  TileColors colors;
  QuadQueue queue;
  Storage<uint32_t> columns;         // inputs and outputs of the pixel shader
  Storage<float> attributes;         // at vertex 0 and the differences to the others
  TileObserver* observer = nullptr;  // only for draw_tile_observed
  std::shared_ptr<MultisampleScratch> multisampled;  // null for targets of one sample
};

// Runs of triangles of one tile, in the order of drawing.
struct TileJob {
  struct Run {
    const Batch* batch;
    uint32_t first;
    uint32_t count;
  };
  const Targets* targets = nullptr;
  const DrawPlan* plans = nullptr;
  const Run* runs = nullptr;
  uint32_t run_count = 0;
  uint32_t x = 0;  // of the tile's first pixel
  uint32_t y = 0;
  uint32_t slice = 0;
  uint32_t width = 0;  // of what all targets have in common
  uint32_t height = 0;
  Observation* observation = nullptr;  // null: nothing is noted
};

using DrawTile = void (*)(const TileJob& job, TileScratch& scratch, ShaderThread& thread);
// For any processor, and for those with AVX2: the same results.
void draw_tile_baseline(const TileJob& job, TileScratch& scratch, ShaderThread& thread);
void draw_tile_avx2(const TileJob& job, TileScratch& scratch, ShaderThread& thread);
// The same again; tells TileScratch::observer what happens.
void draw_tile_observed(const TileJob& job, TileScratch& scratch, ShaderThread& thread);

}  // namespace kaamos::raster
