// SPDX-License-Identifier: MIT
//
// The places of a pixel's samples: D3D12's standard patterns. [D3D11.3: 19.2.4]
#pragma once

#include <cstdint>
#include <span>

#include "runtime/raster/viewport.h"

namespace kaamos::raster {

inline constexpr uint32_t kMostSamples = 8;

// In subpixels from the pixel's upper left corner.
struct SamplePosition {
  int32_t x = kPixelCenter;
  int32_t y = kPixelCenter;
};

namespace sample_positions_detail {

// From the middle, in sixteenths of a pixel.
constexpr SamplePosition at(int32_t x, int32_t y) {
  constexpr int32_t kSixteenth = kSubpixels / 16;
  return {kPixelCenter + x * kSixteenth, kPixelCenter + y * kSixteenth};
}
inline constexpr SamplePosition kOne[1] = {at(0, 0)};
inline constexpr SamplePosition kTwo[2] = {at(4, 4), at(-4, -4)};
inline constexpr SamplePosition kFour[4] = {at(-2, -6), at(6, -2), at(-6, 2), at(2, 6)};
inline constexpr SamplePosition kEight[8] = {at(1, -3), at(-1, 3),  at(5, 1), at(-3, -5),
                                             at(-5, 5), at(-7, -1), at(3, 7), at(7, -7)};

}  // namespace sample_positions_detail

constexpr bool has_sample_positions(uint32_t count) {
  return count == 1 || count == 2 || count == 4 || count == 8;
}

// `count`: 1, 2, 4 or 8.
constexpr std::span<const SamplePosition> sample_positions(uint32_t count) {
  switch (count) {
    case 2:
      return sample_positions_detail::kTwo;
    case 4:
      return sample_positions_detail::kFour;
    case 8:
      return sample_positions_detail::kEight;
    default:
      return sample_positions_detail::kOne;
  }
}

}  // namespace kaamos::raster
