// SPDX-License-Identifier: MIT
/// @file
/// Compares two pictures: how far they are apart.
#pragma once

#include <cstdint>
#include <string>

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// The result of compare, over all values of all pixels.
struct ImageDifference {
  double mse = 0.0;           ///< mean of (a - b)^2
  double psnr = 0.0;          ///< decibels against `peak`; +inf for equal pictures
  double bias = 0.0;          ///< mean of a - b
  double max_abs = 0.0;       ///< +inf where a value is finite in one picture only
  std::uint64_t unequal = 0;  ///< values that differ at all
  /// The place of max_abs.
  ///@{
  std::uint32_t worst_x = 0, worst_y = 0, worst_channel = 0;
  ///@}
};

/// Compares all channels. A NaN equals a NaN and an infinity itself; where only one of the two is
/// finite, max_abs is infinite and the value is left out of mse and bias.
/// @errors KA3004 different sizes.
Result<ImageDifference> compare(const FloatImage& a, const FloatImage& b, double peak = 1.0);

/// One line for a failed test: the numbers and the worst pixel.
std::string describe(const ImageDifference& difference);

}  // namespace kaamos::effects
