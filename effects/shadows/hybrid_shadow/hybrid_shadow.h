// SPDX-License-Identifier: MIT
/// @file
/// Shadows of the sun by a ray and a shadow map: hard ones near what casts them, soft ones far from
/// it. [Story 2015: Hybrid Ray-Traced Shadows]
#pragma once

#include <rtapi/rtapi.h>

#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/shadows/shadow_map/shadow_map.h"

namespace kaamos::effects {

/// Constants b0, space3: mirrors ShadowMapConstants and HybridConstants of hybrid_shadow.hlsl.
struct HybridShadowConstants {
  /// The constants of PCSS; `method` does not count. With kShadowMapInnerPenumbra soft shadows
  /// never leave the hard ones of rays, as in the talk.
  ShadowMapConstants map;
  /// Distance to what casts the shadow from which on the map alone says, 0 or more metres: the
  /// talk's world scale over the share that the artist sets.
  float soft_from = 0.5f;
};
static_assert(sizeof(HybridShadowConstants) == 68);

/// The shaders, as they are built into the program. Maps are drawn by those of
/// shadow_draws_library().
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> hybrid_shadow_library();

/// The passes that HybridShadowConstants of `scope.settings` ask for. What they say about maps,
/// their number and size, holds for the pass's life.
/// @errors KA3060 or KA3061 a constant out of its range; KA0965 on Vulkan without graphics
/// pipelines; those of RayPass::create; others of the device, among them KA0990 no memory.
rtapi::Result<std::unique_ptr<EffectPass>> make_hybrid_shadow(const EffectScope& scope);

}  // namespace kaamos::effects
