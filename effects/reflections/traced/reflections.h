// SPDX-License-Identifier: MIT
/// @file
/// Opaque reflections. [Control; Northlight deck: Reflections]
#pragma once

#include "effects/engine/ray_pass.h"
#include "effects/light/lights/lighting.h"

namespace kaamos::effects {

/// A pass whose rays are shaded as reflections by what reflection_shading.hlsli has: a library
/// with that file and a ray generation shader of its own.
RayPassDesc reflection_shading_pass(const char* name, rtapi::ShaderLibrary library,
                                    const char* ray_generation);
/// The pass. Register u0 of space3 is R32G32B32A32_FLOAT, to which the samples are added: radiance
/// over the specular albedo of brdf.hlsli, and the rays' length. Lighting::bind and GpuVolume::bind
/// are needed too.
RayPassDesc reflections_pass(rtapi::ShaderLibrary library);
/// A pass of the same rays that keeps only their length: nothing is shaded.
RayPassDesc reflections_trace_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> reflections_library();

/// The treatment of samples brighter than twice white, which are rare and stand out. [GDC 2018
/// talk]
enum class Fireflies : std::uint32_t {
  kKeep,  ///< nothing
  /// A pilot ray, which is not averaged in, decides whether each sample is the mean of more rays.
  /// The energy stays what it is. A mirror's rays are all alike and have no pilot.
  kRetrace,
  /// The talk's: a bright sample is averaged with more rays. Bright samples count less than others
  /// then, so energy is lost.
  kAverage,
};

/// Constants b0, space3. The lengths are Control's. [survey 6.5]
struct ReflectionConstants {
  float longest = 200.0f;      ///< metres, of the rays of a mirror
  float shortest = 3.0f;       ///< metres, at roughness 1
  float length_jitter = 0.2f;  ///< part of the length that varies
  /// Luminance that a sample is clamped to, as the pixel shows it, in multiples of white; 0: none.
  /// The talk has 10. The energy above is lost.
  float firefly_limit = 0.0f;
  SunAtHits sun_at_hits = SunAtHits::kByRay;  ///< how what rays hit is lit by the sun
  std::uint32_t single_length = 0;            ///< 1: `longest` at every roughness
  Fireflies fireflies = Fireflies::kRetrace;  ///< what is done about them
  std::uint32_t more_rays = 4;                ///< with which a bright sample is averaged
};

}  // namespace kaamos::effects
