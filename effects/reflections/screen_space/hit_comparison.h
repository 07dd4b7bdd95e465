// SPDX-License-Identifier: MIT
/// @file
/// In which ways marches over the picture fail: their hits against those of the same rays through
/// the scene.
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>
#include <string>

#include "effects/assets/image/image.h"
#include "effects/reflections/screen_space/screen_reflections.h"

namespace kaamos::effects {

/// The outcome of a march; mirrors screen_ray.hlsli.
enum MarchOutcome : std::uint32_t {
  kNoRay,         ///< the pixel shows the sky, or the direction is below the surface
  kHit,           ///< a surface of the picture
  kOffScreen,     ///< the ray left the picture, or came behind the near plane
  kHidden,        ///< it passed behind a surface, where the camera sees nothing
  kBackFacing,    ///< it met only sides of surfaces that face away
  kEnded,         ///< it ended in front of a surface
  kSky,           ///< it ended in front of the sky: sky, or something that is not in the picture
  kStale,         ///< it hit what the previous frame does not show
  kOutOfSteps,    ///< the march ended before the ray did
  kNotLookedFor,  ///< no march was sent, or its hit is not to be used
  kMarchOutcomes
};

/// The way the picture shows what a ray hits in the scene; mirrors hit_truth.hlsl.
enum HitTruth : std::uint32_t {
  kNoTruth,     ///< there is no ray
  kNothing,     ///< it hits nothing
  kSeen,        ///< the picture shows the place
  kOutside,     ///< it lies outside of the picture
  kCovered,     ///< something else is in front of it
  kTurnedAway,  ///< the ray hits a side that faces away from the camera
  kHitTruths
};

/// Rays by how they end over the picture and in the scene.
struct HitConfusion {
  /// Pixels by MarchOutcome and HitTruth.
  std::array<std::array<std::uint64_t, kHitTruths>, kMarchOutcomes> counts{};
  /// Hits of the same instance at the same distance within 2 %, by HitTruth.
  std::array<std::uint64_t, kHitTruths> right{};

  std::uint64_t rays() const;     ///< that exist
  std::uint64_t hits() const;     ///< marches that found something
  std::uint64_t correct() const;  ///< of them, those that found what the ray hits
  /// Marches that missed what the picture shows: it lies between their samples, behind their end,
  /// or they took another surface to be in front.
  std::uint64_t missed() const;
  /// Hits of surfaces that the ray passes behind, by their thickness, or of the wrong one.
  std::uint64_t false_hits() const { return hits() - correct(); }
  /// The part of the rays that needs no fallback; 0 without rays.
  double coverage() const;
  /// A table with a line per outcome.
  std::string table() const;
};

/// The last sample of a march and the truth about it.
struct HitComparison {
  HitConfusion confusion;  ///< of all pixels
  FloatImage hits;         ///< u1 of make_screen_reflections
  /// The distance at which the ray hits (metres), HitTruth, instance + 1, and 1 where the march is
  /// right.
  FloatImage truth;
};

/// Traces the rays of sample `sample` of a march, whose u1 is `hits`, through the scene.
/// @errors those of RayPass::create and of the device.
rtapi::Result<HitComparison> compare_hits(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                          const Frame& frame, const GpuScene& gpu,
                                          const rtapi::Texture& hits,
                                          const ScreenReflectionConstants& constants,
                                          std::uint32_t sample);

}  // namespace kaamos::effects
