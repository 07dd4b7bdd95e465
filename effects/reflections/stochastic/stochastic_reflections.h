// SPDX-License-Identifier: MIT
/// @file
/// Stochastic screen-space reflections: few rays, shared by neighbours. [Stachowiak 2015]
#pragma once

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/reflections/screen_space/screen_reflections.h"

namespace kaamos::effects {

/// Constants b0, space3.
struct StochasticConstants {
  ScreenReflectionConstants screen;  ///< of the march
  std::uint32_t neighbours = 9;      ///< rays that a pixel takes: 1, 4 or 9
  /// Part of the lobe that directions are drawn from, 0 to 1. Below 1 the rarest, which are the
  /// noisiest, are left out, and highlights lose their tails.
  float tail = 1.0f;
};

/// The pass. Register u0 of space3 is a sum as that of reflections_pass. Rays are sent by one of
/// 2 x 2 pixels, another one for each sample; mirrors send their own. EffectNeeds::radiance, lights
/// and volume are needed.
/// @errors KA3071 constants out of their ranges; those of EnvironmentMap::create.
rtapi::Result<std::unique_ptr<EffectPass>> make_stochastic_reflections(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> stochastic_reflections_library();

}  // namespace kaamos::effects
