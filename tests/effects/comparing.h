// SPDX-License-Identifier: MIT
//
// Measures how far apart two renderings of the same scene are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rig.h"

namespace kaamos::test {

// The names of pictures that differ in any byte, leaving out those in `but`.
std::string differing(const Pictures& a, const Pictures& b, const std::vector<std::string>& but);

// 20 log10 of the reference's largest finite value over the root mean square difference; 200 for
// equal pictures. A value that is finite in only one picture counts as off by that largest value.
double decibels(const effects::FloatImage& a, const effects::FloatImage& reference);

// The number of pixels with a channel off by more than `relative` times the reference's largest
// value.
std::uint32_t pixels_off(const effects::FloatImage& a, const effects::FloatImage& reference,
                         double relative);

// The picture flipped left to right.
effects::FloatImage reversed(const effects::FloatImage& image);

// The number of values that are not finite, in all pictures or in one.
std::uint32_t not_finite(const effects::FloatImage& image);
// Names and counts of pictures with non-finite values.
std::string not_finite(const Pictures& pictures);

}  // namespace kaamos::test
