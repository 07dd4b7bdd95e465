// SPDX-License-Identifier: MIT
/// @file
/// Shadows of glass by a map: the colour of all panes of a texel, and the depth of the nearest.
/// [survey 5.3; Filion & McNaughton 2008]
#pragma once

#include <rtapi/rtapi.h>

#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/shadows/shadow_map/shadow_map.h"

namespace kaamos::effects {

/// Constants b0, space3: mirrors ShadowMapConstants and GlassMapConstants of
/// glass_shadow_map.hlsl.
struct GlassShadowMapConstants {
  /// Size, biases, radius and taps count; there is one map, over all glass.
  ShadowMapConstants map{.flags = kShadowMapReceiverPlane, .constant_bias = 0.5f, .slope_bias = 0};
  float tint = 1.0f;  ///< GlassShadowConstants::tint
};
static_assert(sizeof(GlassShadowMapConstants) == 68);

/// The shaders, as they are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> glass_shadow_map_library();

/// The passes: draws of all glass as the sun sees it, and the lookup, which writes register u0 of
/// space3 as glass_shadow_pass does, but no sum. The map's size holds for the pass's life.
/// @errors KA3060 a constant out of its range; KA0965 on Vulkan without graphics pipelines; others
/// of the device, among them KA0990 no memory.
rtapi::Result<std::unique_ptr<EffectPass>> make_glass_shadow_map(const EffectScope& scope);

}  // namespace kaamos::effects
