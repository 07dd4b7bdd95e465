// SPDX-License-Identifier: MIT
//
// The render targets of a tile while its triangles are drawn: texels as their formats have them, in
// the order of pixel shaders, so that a quad's lie side by side.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/raster/draw.h"
#include "runtime/raster/storage.h"

namespace kaamos::raster {

class TileColors {
 public:
  // Rows of the tile that are fetched together: bit i stands for the i-th eight.
  static constexpr uint32_t kBandRows = 8;

  // The tile of a slice of the targets whose first pixel is (x, y). What is cleared is there.
  void begin(const Targets& targets, uint32_t x, uint32_t y, uint32_t slice);
  // Fetches bands of a target, except those that are there.
  void load(uint32_t target, uint32_t bands) {
    bands &= ~bands_[target];
    if (bands != 0) load_new(target, bands);
  }
  // Quad by quad, row by row of quads: for each word of a texel the words of four pixels.
  uint32_t* words(uint32_t target) { return words_.data() + first_[target]; }
  // Writes back what was fetched.
  void store() const;

 private:
  void fill(uint32_t target);  // of a target that is cleared
  void load_new(uint32_t target, uint32_t bands);

  const Targets* targets_ = nullptr;
  uint32_t x_ = 0, y_ = 0, slice_ = 0;
  Storage<uint32_t> words_;
  std::array<uint32_t, rtapi::kSimultaneousRenderTargetCount> first_ = {};  // in words_
  std::array<uint32_t, rtapi::kSimultaneousRenderTargetCount> bands_ = {};  // that are there
};

}  // namespace kaamos::raster
