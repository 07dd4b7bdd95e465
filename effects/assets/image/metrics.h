// SPDX-License-Identifier: MIT
/// @file
/// Tells how far a picture is from its reference, in the measures that rendering papers use.
///
/// Every measure leaves out values that are not finite in either picture and counts them in
/// `not_finite`, so that a broken picture cannot look good silently.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// The result of measure, over the values x of the picture and r of the reference.
struct Metrics {
  double rmse = 0;          ///< square root of the mean of (x - r)^2
  double relative_mse = 0;  ///< mean of (x - r)^2 / (r^2 + 0.01)
  /// The same without the worst thousandth of the values: fireflies show as the difference.
  double trimmed_relative_mse = 0;
  double psnr = 0;               ///< decibels against 1; +inf for equal pictures
  double bias = 0;               ///< mean of x - r
  double energy_ratio = 1;       ///< sum of x over sum of r; 1 where both are 0
  std::uint64_t not_finite = 0;  ///< values left out
};

/// `mask`: which pixels count, not 0; empty: all.
/// @errors KA3004 different sizes.
Result<Metrics> measure(const FloatImage& picture, const FloatImage& reference,
                        std::span<const std::uint8_t> mask = {});

/// Structural similarity of two pictures of values in [0, 1]: mean over the pixels of the mean over
/// the channels, windows of 11 x 11 with a Gaussian of 1.5 pixels, the border repeated. [Wang et
/// al. 2004]
/// @errors KA3004 different sizes.
Result<double> ssim(const FloatImage& picture, const FloatImage& reference);

/// The parts of an estimator's error, found from several renderings with independent seeds: bias^2
/// and variance, mean over all values; bias^2 is corrected for the variance that is left in the
/// mean of finitely many pictures, so it may come out slightly negative.
struct ErrorParts {
  double bias_squared = 0;  ///< of the mean of the pictures
  double variance = 0;      ///< of one picture
  /// The mean squared error that the two make.
  double total() const { return bias_squared + variance; }
};
/// @errors KA3004 fewer than 2 pictures, different sizes.
Result<ErrorParts> split_error(std::span<const FloatImage> pictures, const FloatImage& reference);

/// Mean absolute change from one frame to the next where nothing moves, less the reference's own.
/// @errors KA3004 different sizes.
Result<double> flicker(const FloatImage& previous, const FloatImage& current,
                       const FloatImage& previous_reference, const FloatImage& reference);

}  // namespace kaamos::effects
