// SPDX-License-Identifier: MIT
/// @file
/// Shadow of a sun with an area: how many samples see it, and how sharp the shadows of the others
/// are.
#pragma once

#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// Samples per pixel of the deck's timings. [Northlight deck: Shadows]
inline constexpr std::uint32_t kDefaultSunSamples = 2;

/// The pass. Each dispatch adds those of its samples that see the sun to register u0 of space3,
/// R32_FLOAT, and of the others to u1, R32G32B32A32_FLOAT: 1 / radius of the penumbra that the
/// closest occluder casts, 1/m, and whether that moves.
/// [Northlight deck: Shadows; NRD: SIGMA]
RayPassDesc sun_shadow_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> sun_shadow_library();

}  // namespace kaamos::effects
