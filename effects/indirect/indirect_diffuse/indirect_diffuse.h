// SPDX-License-Identifier: MIT
/// @file
/// Indirect diffuse light of each pixel. [Northlight deck: Indirect Diffuse Illumination]
#pragma once

#include "effects/engine/ray_pass.h"
#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/light/lights/lighting.h"

namespace kaamos::effects {

/// The pass. Register u0 of space3 is R32G32B32A32_FLOAT, to which the samples are added:
/// irradiance over pi, and the rays' length. Lighting::bind and GpuVolume::bind are needed too.
RayPassDesc indirect_diffuse_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> indirect_diffuse_library();

/// The source of a pixel's light. [Northlight deck: Indirect Diffuse Illumination]
enum class IndirectMode : std::uint32_t {
  kDirect,           ///< the volume, sampled at the surface
  kHitBlack,         ///< rays sample it where they end, what they hit is black
  kNearField,        ///< what they hit is lit, and sends its light everywhere alike
  kNearFieldGlossy,  ///< what they hit is shaded by its material, as in reflections
  kTimesOpen,        ///< as kDirect, times the part of the rays that hit nothing
};

/// Constants b0, space3.
struct IndirectConstants {
  IndirectMode mode = IndirectMode::kNearField;  ///< where light comes from
  float length = 3.0f;                           ///< of the rays, metres; at least two cells
  SunAtHits sun_at_hits = SunAtHits::kByRay;     ///< how what rays hit is lit by the sun
};

}  // namespace kaamos::effects
