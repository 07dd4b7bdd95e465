// SPDX-License-Identifier: MIT
/// @file
/// The difference that a person sees when two pictures alternate. [Andersson et al. 2020, FLIP: A
/// Difference Evaluator for Alternating Images]
#pragma once

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// A monitor of 0.7 m width and 3840 pixels, 0.7 m away.
inline constexpr double kDefaultPixelsPerDegree = 67.0206;

/// The result of flip.
struct Flip {
  FloatImage map;   ///< 1 channel, 0 equal .. 1 as different as can be
  double mean = 0;  ///< over the map
};

/// Two pictures of 3 channels as a screen shows them: sRGB-encoded, in [0, 1]; other values are
/// clamped, NaN counts as 0.
/// @errors KA3004 not 3 channels, different sizes.
Result<Flip> flip(const FloatImage& picture, const FloatImage& reference,
                  double pixels_per_degree = kDefaultPixelsPerDegree);

}  // namespace kaamos::effects
