// SPDX-License-Identifier: MIT
//
// Stencil of pixels: the test, and what becomes of the stored values after the depth test.
#pragma once

#include <bit>

#include "runtime/raster/lanes.h"
#include "runtime/raster/stencil.h"
#include "runtime/raster/triangle.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

// Of eight pixels, which bits and bytes stand for in the order of pixel shaders.
struct StencilTest {
  const StencilFace& face;

  StencilTest(const StencilTables& tables, const Triangle& triangle)
      : face((triangle.flags & kFrontFacing) != 0 ? tables.front : tables.back) {}

  // Those of `active` that pass.
  uint32_t run(const uint8_t stored[8], uint32_t active) const {
    uint32_t passed = 0;
    for (uint32_t i = 0; i < 8; ++i) passed |= uint32_t{face.passes[stored[i]]} << i;
    return passed & active;
  }
  // Those of `active` that are in `passed` passed here, those in `passed_depth` also the depth
  // test.
  void update(uint8_t stored[8], uint32_t active, uint32_t passed, uint32_t passed_depth) const {
    for (uint32_t bits = active; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(bits));
      const uint8_t* const after = (passed_depth >> i & 1) != 0 ? face.passed
                                   : (passed >> i & 1) != 0     ? face.depth_failed
                                                                : face.failed;
      stored[i] = after[stored[i]];
    }
  }
};

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
