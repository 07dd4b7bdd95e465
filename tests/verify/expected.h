// SPDX-License-Identifier: MIT
//
// What the picture must be, from closed forms in double precision. Nothing here is part of Kaamos'
// libraries, so it shares none of their faults.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/verify/scene.h"

namespace kaamos::verify {

// The texel of a pixel; none where rounding may decide: within 0.001 of a triangle's edge, of the
// ellipsoid's outline, or of a shadow's.
std::optional<Texel> expected_texel(uint32_t x, uint32_t y);

struct Comparison {
  uint32_t compared = 0;     // texels with an expected value
  double largest_error = 0;  // of t (relative) and attributes
  std::string failure;       // the first wrong texel, what was found and expected; empty: none
};
// `texels`: kTexels, row after row. t may be off by 1e-4 of itself, an attribute by 1e-3.
Comparison compare(const std::vector<Texel>& texels);

}  // namespace kaamos::verify
