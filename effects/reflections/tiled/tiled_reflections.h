// SPDX-License-Identifier: MIT
/// @file
/// Reflections whose tiles are classified before rays are traced. [survey 6.4]
#pragma once

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/light/lights/lighting.h"
#include "effects/reflections/screen_space/screen_reflections.h"

namespace kaamos::effects {

/// Constants b0, space3.
struct TiledConstants {
  ScreenReflectionConstants screen;           ///< `edge_fade` is not used: rays go on
  SunAtHits sun_at_hits = SunAtHits::kByRay;  ///< ReflectionConstants::sun_at_hits
  float roughest_screen = 1;                  ///< rougher surfaces are traced at once
  float roughest_traced = 0.6f;               ///< rougher surfaces show `screen.fallback`
};

/// The class of a pixel, and of a tile: that of its dearest pixel.
enum class ReflectionClass : std::uint32_t {
  kNothing,        ///< the sky
  kByEnvironment,  ///< rougher than TiledConstants::roughest_traced
  kByPicture,      ///< strict hits in the picture
  kByRays,         ///< all else
};

/// The march of default_hybrid_constants, and the environment map for rough surfaces.
TiledConstants default_tiled_constants();

/// The passes: classes of 8 x 8 pixels, which store what needs no ray, and rays for a list of tiles
/// whose length only the device knows. Registers u0 and u1 of space3 as make_hybrid_reflections has
/// them; u2 has ReflectionClass of the pixel in x and of its tile in y. EffectNeeds::radiance,
/// lights and volume are needed. EffectSettings::pixel_step is taken as 1.
/// @errors KA3071 constants out of their ranges; KA0541 a device below tier 1.1; those of
/// EnvironmentMap::create and of RayPass::create.
rtapi::Result<std::unique_ptr<EffectPass>> make_tiled_reflections(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> tiled_reflections_library();

}  // namespace kaamos::effects
