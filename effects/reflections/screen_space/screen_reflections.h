// SPDX-License-Identifier: MIT
/// @file
/// Reflections that are found in the picture itself. [survey 6.2; McGuire & Mara 2014; GDC 2018
/// talk]
#pragma once

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/reflections/environment_map/environment_map.h"

namespace kaamos::effects {

/// The most samples of a ray, and the most halvings of a step.
///@{
inline constexpr std::uint32_t kMostScreenSteps = 4096;
inline constexpr std::uint32_t kMostScreenRefinements = 32;
///@}

/// The places where a march takes its samples.
enum class ScreenMarch : std::uint32_t {
  kMetres,  ///< at equal distances along the ray, each a point [survey 6.2]
  /// Every few pixels of the picture; the ray's depths between two samples count too.
  /// [McGuire & Mara 2014]
  kPixels,
  /// Likewise, but a fixed number up to the edge of the picture. [GDC 2018 talk]
  kLine,
};

/// The source of the light of hits.
enum class ScreenSource : std::uint32_t {
  kCurrentFrame,   ///< this frame before it has reflections
  kPreviousFrame,  ///< the finished frame before, where the surface was then; else the current one
};

/// The light that rays without a hit show.
enum class ScreenFallback : std::uint32_t {
  kNone,         ///< nothing
  kSky,          ///< the sky
  kEnvironment,  ///< the environment map [effects/reflections/environment_map]
};

/// Constants b0, space3.
struct ScreenReflectionConstants {
  float longest = 200.0f;                    ///< metres, of the rays of a mirror
  float shortest = 3.0f;                     ///< metres, at roughness 1
  float length_jitter = 0.2f;                ///< part of the length that varies
  ScreenMarch march = ScreenMarch::kPixels;  ///< where samples are
  std::uint32_t steps = 256;                 ///< samples of a ray at most
  std::uint32_t refinements = 0;             ///< halvings of the step in which a surface is crossed
  float stride = 1.0f;                       ///< pixels, at least 1; of kPixels
  float thickness = 0.25f;                   ///< metres that surfaces are taken to reach back
  float edge_fade = 0.05f;  ///< part of the picture, at its edge, where hits fade to the fallback
  ScreenSource source = ScreenSource::kCurrentFrame;       ///< of light
  ScreenFallback fallback = ScreenFallback::kEnvironment;  ///< of rays without a hit
  std::uint32_t strict = 0;  ///< 1: only hits that leave no doubt count
  /// Thickness besides, in depths of the step from sample to sample: so that no surface is thinner
  /// than what a step passes by.
  float step_thickness = 0.0f;
};

/// Points along the ray, 64 up to 20 m, and a search where one is behind a surface.
/// [survey 6.2]
ScreenReflectionConstants march_of_metres();
/// Every pixel that the ray passes over, up to 256. [McGuire & Mara 2014]
ScreenReflectionConstants march_of_pixels();
/// 32 samples up to the edge of the picture, and nothing for misses. [GDC 2018 talk]
ScreenReflectionConstants march_of_line();

/// The pass. Register u0 of space3 is a sum as that of reflections_pass, with the same rays; u1 is
/// of the last sample: the place in the picture that was hit (pixels), the distance (metres), and
/// how the march ended [MarchOutcome]. EffectNeeds::radiance is needed, and for
/// ScreenFallback::kEnvironment what EnvironmentMap::create needs.
/// @errors KA3071 constants out of their ranges; KA0537 a library without the pass; those of
/// EnvironmentMap::create.
rtapi::Result<std::unique_ptr<EffectPass>> make_screen_reflections(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> screen_reflections_library();

/// Checks the constants. Other passes that march over the picture share this function and the next.
/// @errors KA3071 a number or an enumeration out of its range.
rtapi::Status check_screen_reflections(const ScreenReflectionConstants& constants);
/// Binds the mask of each instance, one word each, as marches read them: t4 of space3. The buffer
/// must stay for the pass's life.
/// @errors those of rtapi::Device::CreateBuffer.
rtapi::Result<rtapi::Buffer> bind_instance_masks(const EffectScope& scope);

/// The inputs that a march in the picture reads besides it: masks of instances, and what is seen
/// where it finds nothing.
class ScreenInputs {
 public:
  /// Checks the constants, binds the masks, and makes an environment map where the constants want
  /// one. The scope's device and views must stay.
  /// @errors KA3071 constants out of their ranges; those of EnvironmentMap::create.
  static rtapi::Result<ScreenInputs> create(const EffectScope& scope,
                                            const ScreenReflectionConstants& constants);
  /// Their part of EffectPass::begin_frame.
  /// @errors those of EnvironmentMap::set_origin.
  rtapi::Status begin_frame(const Camera& camera) { return environment_.begin_frame(camera); }
  /// Bytes of both.
  std::uint64_t bytes() const { return masks_.size() + environment_.bytes(); }

 private:
  rtapi::Buffer masks_;
  EnvironmentFallback environment_;
};

}  // namespace kaamos::effects
