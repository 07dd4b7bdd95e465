// SPDX-License-Identifier: MIT
/// @file
/// Screen-space mirrors at a quarter of the pixels, blurred by roughness. [Valient 2014]
#pragma once

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/reflections/screen_space/screen_reflections.h"

namespace kaamos::effects {

/// Constants b0, space3. The last two words are the pass's own.
struct BlurredConstants {
  ScreenReflectionConstants screen;  ///< of the march
  float fresh = 0.5f;                ///< 0 to 1: weight of a new ray beside the frames before
  float few_taps = 0.2f;             ///< roughness up to which 12 taps blur in place of mips
  std::uint32_t has_history = 0;     ///< set by the pass
  std::uint32_t level = 0;           ///< set by the pass
};

/// The pass. Register u0 of space3 is no sum: radiance as reflections_pass has it. One of 2 x 2
/// pixels sends a ray, another one in each frame; the others keep what they had where their surface
/// was. EffectNeeds::radiance, lights and volume are needed.
/// @errors KA3071 constants out of their ranges; those of EnvironmentMap::create.
rtapi::Result<std::unique_ptr<EffectPass>> make_blurred_reflections(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> blurred_reflections_library();

}  // namespace kaamos::effects
