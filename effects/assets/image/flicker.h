// SPDX-License-Identifier: MIT
/// @file
/// Measures how much the pictures of a sequence change beyond what motion explains: boiling noise,
/// crawling edges.
#pragma once

#include <cstdint>

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// The surfaces of a frame of a sequence.
struct FrameSurfaces {
  FloatImage view_z;  ///< 1 channel, metres, 0 nothing
  /// 3 channels or more: where each surface was a frame ago, picture widths and heights from here,
  /// and the change of its depth. [effects/shaders/frame.hlsli: g_motion]
  FloatImage motion;
};

/// Sums over any number of pairs of frames.
struct TemporalChange {
  double difference = 0;         ///< sum of |now - then|
  double value = 0;              ///< sum of |now|
  std::uint64_t count = 0;       ///< values: pixels times channels
  std::uint64_t hidden = 0;      ///< pixels left out: no surface, or not seen a frame ago
  std::uint64_t not_finite = 0;  ///< values left out, NaN or infinite

  /// Adds the sums of another pair of frames.
  void add(const TemporalChange& other);
  /// Mean change of a value from one frame to the next.
  double mean() const { return count > 0 ? difference / static_cast<double>(count) : 0.0; }
  /// The same, relative to the mean value; brightness does not matter.
  double relative() const { return value > 0 ? difference / value : 0.0; }
};

/// Compares `now` with `then`, carried along with the surfaces (bilinear): 3 channels of 3 or 4, or
/// 1. Pixels without a surface, and those whose surface was outside of the picture or hidden a
/// frame ago, do not count.
/// @errors KA3004 different sizes.
Result<TemporalChange> temporal_change(const FloatImage& then, const FloatImage& now,
                                       const FloatImage& previous_view_z,
                                       const FrameSurfaces& surfaces);

}  // namespace kaamos::effects
