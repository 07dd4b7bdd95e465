// SPDX-License-Identifier: MIT
/// @file
/// Shadow of a sun with an area. The pass adds the number of samples that see it to
/// kSunVisibilitySum, and how sharp the shadows of the others are to kSunSharpnessSum.
#pragma once

#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// Samples per pixel of the deck's timings. [Northlight deck: Shadows]
inline constexpr std::uint32_t kDefaultSunSamples = 2;

/// The pass. Each dispatch adds those of its samples that see the sun to kSunVisibilitySum, and of
/// the others to kSunSharpnessSum: 1 / radius of the penumbra that the closest occluder casts, 1/m,
/// and whether that moves.
/// [Northlight deck: Shadows; NRD: SIGMA]
RayPassDesc sun_shadow_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> sun_shadow_library();

}  // namespace kaamos::effects
