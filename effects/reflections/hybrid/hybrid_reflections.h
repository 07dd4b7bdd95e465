// SPDX-License-Identifier: MIT
/// @file
/// Reflections from the picture where it leaves no doubt, by rays elsewhere. [survey 6.4]
#pragma once

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/light/lights/lighting.h"
#include "effects/reflections/screen_space/screen_reflections.h"

namespace kaamos::effects {

/// Constants b0, space3.
struct HybridConstants {
  ScreenReflectionConstants screen;  ///< `fallback` and `edge_fade` are not used: rays go on
  SunAtHits sun_at_hits = SunAtHits::kByRay;  ///< ReflectionConstants::sun_at_hits
  float roughest_screen = 1;                  ///< rougher surfaces are traced at once
};

/// Strict hits of surfaces that are 2 cm thick.
HybridConstants default_hybrid_constants();

/// The pass. Registers u0 and u1 of space3 as make_screen_reflections has them; the ray of a sample
/// without a strict hit is traced and shaded as that of reflections_pass. EffectNeeds::radiance,
/// lights and volume are needed.
/// @errors KA3071 constants out of their ranges; those of RayPass::create.
rtapi::Result<std::unique_ptr<EffectPass>> make_hybrid_reflections(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> hybrid_reflections_library();

}  // namespace kaamos::effects
