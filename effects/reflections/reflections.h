// SPDX-License-Identifier: MIT
/// @file
/// Opaque reflections. [effects-spec B4.10]
#pragma once

#include "effects/frame/ray_pass.h"

namespace kaamos::effects {

/// The pass. Register u0 of space3 is R32G32B32A32_FLOAT, to which the samples are added: radiance
/// over the specular albedo of brdf.hlsli, and the rays' length. Lighting::bind and GpuVolume::bind
/// are needed too.
RayPassDesc reflections_pass(rtapi::ShaderLibrary library);
/// A pass of the same rays that keeps only their length: nothing is shaded.
RayPassDesc reflections_trace_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> reflections_library();

/// Constants b0, space3. The lengths are Control's. [effects-spec B4.10]
struct ReflectionConstants {
  float longest = 200.0f;           ///< metres, of the rays of a mirror
  float shortest = 3.0f;            ///< metres, at roughness 1
  float length_jitter = 0.2f;       ///< part of the length that varies
  float firefly_limit = 0.0f;       ///< luminance that a sample is clamped to; 0: none
  std::uint32_t sun_at_hits = 1;    ///< 1: what rays hit is lit by the sun, by a ray; 0: it is not
  std::uint32_t single_length = 0;  ///< 1: `longest` at every roughness
};

}  // namespace kaamos::effects
