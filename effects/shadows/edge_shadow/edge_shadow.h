// SPDX-License-Identifier: MIT
/// @file
/// Shadows of the sun by rays at their edges alone, which a shadow map finds. [survey 4]
#pragma once

#include <rtapi/rtapi.h>

#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/shadows/shadow_map/shadow_map.h"

namespace kaamos::effects {

/// Constants b0, space3: mirrors ShadowMapConstants and EdgeConstants of edge_shadow.hlsl.
struct EdgeShadowConstants {
  /// The map. The pass asks `taps` x `taps` of its texels, at most `radius` metres from a surface.
  ShadowMapConstants map;
  float margin = 1.5f;  ///< texels that the map may be wrong, 0 to 64
};
static_assert(sizeof(EdgeShadowConstants) == 68);

/// The place of a pixel, in register u1.
enum class EdgePlace : std::uint32_t {
  kLit,   ///< nothing that is near enough in the map hides the sun
  kDark,  ///< all that is near enough does
  kEdge,  ///< neither: rays decide
};

/// The shaders, as they are built into the program. Maps are drawn by those of
/// shadow_draws_library().
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> edge_shadow_library();

/// The passes that EdgeShadowConstants of `scope.settings` ask for; EffectSettings::samples are the
/// rays of an edge's pixel, those of the effect "sun". Register u1 has EdgePlace in x and the rays
/// in y. What the constants say about maps, their number and size, holds for the pass's life.
/// @errors KA3060 a constant out of its range; KA0965 on Vulkan without graphics pipelines; those
/// of RayPass::create; others of the device, among them KA0990 no memory.
rtapi::Result<std::unique_ptr<EffectPass>> make_edge_shadow(const EffectScope& scope);

}  // namespace kaamos::effects
