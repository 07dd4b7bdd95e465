// SPDX-License-Identifier: MIT
//
// What a thread needs to draw tiles of targets with several samples: for each sample a tile of its
// own, and the samples of one triangle's quads.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/raster/sample_positions.h"
#include "runtime/raster/tile.h"

namespace kaamos::raster {

inline constexpr uint32_t kTileQuads = kTilePixels / 4;

struct MultisampleScratch {
  struct Sample {
    TileDepth depth;
    TileStencil stencil;
    TileColors colors;
    Targets plane;  // the targets' texels of this sample
  };
  std::array<Sample, kMostSamples> samples;

  // Bits 4 * s to 4 * s + 3 are sample s of a quad's pixels. All 0 between triangles.
  std::array<uint32_t, kTileQuads> covered = {};
  std::array<uint32_t, kTileQuads> passed;  // the early tests; valid where `covered` is not 0
  // Quads of the triangle that are covered.
  std::array<uint16_t, kTileQuads> quads;
  uint32_t quad_count = 0;
};

}  // namespace kaamos::raster
