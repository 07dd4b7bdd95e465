// SPDX-License-Identifier: MIT
//
// Direct3D's standard patterns: where the samples of a pixel lie, from its middle, in sixteenths of
// a pixel, y down. [D3D11.3: 19.2.4]
#pragma once

#include <cstdint>

namespace kaamos::shader {

struct SampleOffset {
  int8_t x, y;
};

inline constexpr SampleOffset kOneSample[1] = {{0, 0}};
inline constexpr SampleOffset kTwoSamples[2] = {{4, 4}, {-4, -4}};
inline constexpr SampleOffset kFourSamples[4] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
inline constexpr SampleOffset kEightSamples[8] = {{1, -3}, {-1, 3},  {5, 1}, {-3, -5},
                                                  {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};

}  // namespace kaamos::shader
