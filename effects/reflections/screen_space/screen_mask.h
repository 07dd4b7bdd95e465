// SPDX-License-Identifier: MIT
/// @file
/// Screen-space reflections for those pixels alone that may find something. [survey 6.2]
#pragma once

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/reflections/screen_space/screen_reflections.h"

namespace kaamos::effects {

/// Constants b0, space3.
struct ScreenMaskConstants {
  ScreenReflectionConstants screen;  ///< of the march
  float roughest = 1.0f;             ///< rougher surfaces show what a miss shows
  /// 1: a march over blocks of 8 x 8 pixels, which never misses a hit, decides besides; 0:
  /// roughness alone.
  std::uint32_t march_blocks = 1;
  /// 1: marks of half the resolution decide in its place, around pixels of which a coarse march
  /// meets something. They may miss hits. [Wronski 2014]
  std::uint32_t half_mask = 0;
  /// Pixels of half the resolution that are marked around one, to each side; 0 to 64.
  std::uint32_t dilation = 2;
};

/// The pass: a mask, a list of its pixels, and the march for a number of them that only the device
/// knows. Registers u0 and u1 of space3 as make_screen_reflections has them; with `roughest` 1 they
/// hold the same light, but for what `half_mask` misses. u1 says kNotLookedFor where the mask is
/// not set. Needs as there. EffectSettings::pixel_step is taken as 1.
/// @errors KA3071 constants out of their ranges; those of EnvironmentMap::create.
rtapi::Result<std::unique_ptr<EffectPass>> make_masked_reflections(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> screen_mask_library();

}  // namespace kaamos::effects
