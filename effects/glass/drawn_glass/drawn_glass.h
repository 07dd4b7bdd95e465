// SPDX-License-Identifier: MIT
/// @file
/// Glass by draws, of which the nearest layer has a ray traced mirror image. [Control; survey 6.5]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/glass/transparent/transparent.h"

namespace kaamos::effects {

/// DrawnGlassConstants::fallback: what layers mirror that no ray was traced for.
enum class DrawnGlassFallback : std::uint32_t {
  kNothing,      ///< black
  kEnvironment,  ///< the environment map
};

/// Constants b0, space3: mirrors the first words of DrawnGlassConstants of drawn_layer.hlsli. The
/// last four words are the pass's own.
struct DrawnGlassConstants {
  /// The constants of the rays. Counts of layers, weight and scale of a blend are not used.
  TransparentConstants rays;
  /// Part of its view depth by which a layer may miss the depth of the layer that the ray met, and
  /// still have its mirror image. Negative: none has.
  float tolerance = 1e-4f;
  DrawnGlassFallback fallback = DrawnGlassFallback::kEnvironment;  ///< of all other layers
  std::uint32_t draw = 0;                                          ///< set by the pass
  float clip_scale = 0;                                            ///< set by the pass
  float width = 0;                                                 ///< set by the pass, pixels
  float height = 0;                                                ///< likewise
};
static_assert(sizeof(DrawnGlassConstants) == 56);

/// The passes: a ray for each pixel to the nearest glass and on to what that mirrors, draws of all
/// glass from back to front, and what joins them. Registers u0 and u1 of space3 get what
/// transparent_pass writes there, but no depth without rays (`tolerance` below 0).
/// EffectNeeds::lights and volume are needed.
/// @errors KA0965 on Vulkan without graphics pipelines; those of EnvironmentMap::create and of
/// RayPass::create; those of the device, among them KA0990 no memory.
rtapi::Result<std::unique_ptr<EffectPass>> make_drawn_glass(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> drawn_glass_library();

}  // namespace kaamos::effects
