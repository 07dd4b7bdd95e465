// SPDX-License-Identifier: MIT
//
// The places of a pixel's samples: D3D12's standard patterns. [D3D11.3: 19.2.4]
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <kaamos/shader/sample_patterns.h>

#include "runtime/raster/viewport.h"

namespace kaamos::raster {

inline constexpr uint32_t kMostSamples = 8;

// In subpixels from the pixel's upper left corner.
struct SamplePosition {
  int32_t x = kPixelCenter;
  int32_t y = kPixelCenter;
};

namespace sample_positions_detail {

template <size_t kCount>
constexpr std::array<SamplePosition, kCount> in_subpixels(
    const shader::SampleOffset (&pattern)[kCount]) {
  constexpr int32_t kSixteenth = kSubpixels / 16;
  std::array<SamplePosition, kCount> out;
  for (size_t i = 0; i < kCount; ++i) {
    out[i] = {kPixelCenter + pattern[i].x * kSixteenth, kPixelCenter + pattern[i].y * kSixteenth};
  }
  return out;
}
inline constexpr auto kOne = in_subpixels(shader::kOneSample);
inline constexpr auto kTwo = in_subpixels(shader::kTwoSamples);
inline constexpr auto kFour = in_subpixels(shader::kFourSamples);
inline constexpr auto kEight = in_subpixels(shader::kEightSamples);

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
