// SPDX-License-Identifier: MIT
//
// How far two renderings of the same thing are apart.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rig.h"

namespace kaamos::test {

// The names of pictures that do not hold the same bytes; those in `but` are not looked at.
std::string differing(const Pictures& a, const Pictures& b, const std::vector<std::string>& but);

// 20 log10 of the reference's largest finite value over the root mean square difference; 200 for
// equal pictures. What is finite in one picture alone counts as off by that value.
double decibels(const effects::FloatImage& a, const effects::FloatImage& reference);

// Pixels that have a channel further apart than `relative` times the reference's largest value.
std::uint32_t pixels_off(const effects::FloatImage& a, const effects::FloatImage& reference,
                         double relative);

// The picture from right to left.
effects::FloatImage reversed(const effects::FloatImage& image);

// How many values are not finite, over all pictures or in one.
std::uint32_t not_finite(const effects::FloatImage& image);
// Names and counts of pictures with values that are not finite.
std::string not_finite(const Pictures& pictures);

}  // namespace kaamos::test
