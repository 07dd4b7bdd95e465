// SPDX-License-Identifier: MIT
/// @file
/// The shadow of one local light, or of each pixel's two strongest, by its map in the atlas, hard
/// or filtered, by rays, and by both. [survey 5.1.4, 5.3; Fernando 2005; Story 2015]
#pragma once

#include <cstdint>

#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// The ways in which it is found.
enum class LampShadow : std::uint32_t {
  kMapHard,  ///< four texels of the map, as main lighting has them
  kMapPcf,   ///< a filter of one width [LampShadowConstants::widest]
  kMapPcss,  ///< a filter as wide as the penumbra, by the mean depth of what stands in between
  kHybrid,   ///< near what casts it a ray, far from it kMapPcss
  kRayHard,  ///< one ray to the light's centre
  kRays,     ///< PassConstants::sample_count rays to its sphere
};

/// LampShadowConstants::light: those that main lighting names for each pixel, the strongest point
/// light and the strongest spot light. [EffectNeeds::strongest_lights]
inline constexpr std::uint32_t kStrongestLamps = 0xFFFFFF;

/// Constants b0, space3: mirrors LampShadowConstants of lamp_shadow.hlsl.
struct LampShadowConstants {
  std::uint32_t light = 0;                   ///< a place in light_constants, or kStrongestLamps
  LampShadow method = LampShadow::kMapPcss;  ///< how it is found
  std::uint32_t taps = 32;                   ///< of the filter, at least 1
  std::uint32_t blocker_taps = 16;  ///< of the search for what casts the shadow, at least 1
  /// z_near of the survey's formulas, metres: how far from the light the search supposes its map to
  /// lie. What stands nearer to the light casts wider penumbras than are looked for.
  float near_plane = 0.25f;
  float widest = 0.5f;     ///< radius of the filter on the surface at most, metres
  float soft_from = 0.5f;  ///< of kHybrid, as HybridShadowConstants::soft_from
};

/// The pass. Register u1 of space3 is R32G32B32A32_FLOAT: the visible part of the light (r), or of
/// the point light (r) and the spot light (g) that u0 names. As
/// everywhere it is 0 beyond the light's range and on surfaces that face away from it, and 1 inside
/// the light; outside of a spot's cone it is 0. Lighting::bind is needed too, with maps.
RayPassDesc lamp_shadow_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> lamp_shadow_library();

}  // namespace kaamos::effects
