// SPDX-License-Identifier: MIT
/// @file
/// Contact shadows from the depth picture, without rays. [survey 5.2]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"

namespace kaamos::effects {

/// Constants b0, space3: mirrors ScreenShadowConstants of screen_space_shadow.hlsl. The defaults
/// are the plain march.
struct ScreenSpaceShadowConstants {
  float length = 0.5f;      ///< of a march, metres; 0: everything is visible
  float thickness = 0.05f;  ///< metres that everything is taken to reach back; 0: nothing hides
  /// Part of its view depth that an occluder must stand above the receiver's plane, -1 to 1. At -1
  /// planes that are seen along themselves shadow themselves.
  float bias = 5e-4f;
  float border = 0.05f;         ///< part of the picture's width over which shadows fade, 0 to 1
  std::uint32_t steps = 16;     ///< of the march with the largest ones, 1 to 1,024
  std::uint32_t marches = 1;    ///< 1 to 4; each has steps 1.618 times smaller than the one before
  std::uint32_t threshold = 1;  ///< marches that must hit, 1 to `marches`
  /// Pixels from a point of the ray to four more places beside it, 0 to 16; 0: only its own pixel
  /// is tested. Places less than a pixel away may be in that pixel.
  float spread = 0.0f;
  std::uint32_t noise = 1;       ///< 0: points at the same distances everywhere, which shows bands
  std::uint32_t toward_sun = 0;  ///< 1: the sun in place of each pixel's strongest lights
};
static_assert(sizeof(ScreenSpaceShadowConstants) == 40);

/// Seibert's spatial depth buffer multisampling: the four pixels beside each point count too.
ScreenSpaceShadowConstants multisampled_shadow();
/// Seibert's multipass occlusion testing: three marches, of which two must hit.
ScreenSpaceShadowConstants multipass_shadow();

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> screen_space_shadow_library();

/// The effect's pass, for rows of the registry. Register u1 gets the visibility: r of the strongest
/// point light or the sun, g of the strongest spot light; final, and not a sum. u0 has the names of
/// the lights, unless the sun is asked for.
/// @errors KA3085 a length, a thickness, a bias or a place that is no such number; KA3086 the
/// number of steps; KA3087 the number of marches, or more hits than those; those of the device.
rtapi::Result<std::unique_ptr<EffectPass>> make_screen_space_shadow(const EffectScope& scope);

}  // namespace kaamos::effects
