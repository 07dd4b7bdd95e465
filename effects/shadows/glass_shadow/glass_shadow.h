// SPDX-License-Identifier: MIT
/// @file
/// Shadows of glass: the colour that it gives to the sun's light. [survey 5.3; McGuire & Enderton
/// 2011]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// Constants b0, space3.
struct GlassShadowConstants {
  /// Part of a pane's own colour that it lets through where it covers, 0 to 1. 0: shadows are grey,
  /// as dark as the camera sees what is behind the pane.
  float tint = 1.0f;
};
static_assert(sizeof(GlassShadowConstants) == 4);

/// The pass. Each dispatch adds to register u0 of space3, R32G32B32A32_FLOAT, what glass lets
/// through of its samples of the sun, by colour; a: their number. Solid things are not in its way:
/// another effect says whether the sun is visible.
RayPassDesc glass_shadow_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> glass_shadow_library();

}  // namespace kaamos::effects
