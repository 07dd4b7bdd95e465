// SPDX-License-Identifier: MIT
#include "effects/shadows/edge_shadow/edge_shadow.h"

#include <shaders/edge_shadow.h>

#include <string>

#include "effects/assets/common/errors.h"
#include "effects/shadows/shadow_map/map_rays.h"

namespace kaamos::effects {
namespace {

constexpr float kWidestMargin = 64;  // texels

class EdgeShadowPass : public MapRays {
 public:
  using MapRays::MapRays;

  rtapi::Status create(const EffectScope& scope) {
    const float margin = scope.settings.get_constants<EdgeShadowConstants>().margin;
    if (!(margin >= 0.0f && margin <= kWidestMargin)) {
      return make_error(
          ErrorId::kShadowMap,
          "EdgeShadowConstants::margin is " + std::to_string(margin) + "; choose 0 to 64 texels");
    }
    return MapRays::create(
        scope, occluder_pass("edge shadow", scope.library("shadows/edge_shadow/edge_shadow"),
                             "EdgeShadowRayGen"));
  }
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> edge_shadow_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_edge_shadow());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_edge_shadow(const EffectScope& scope) {
  return make_pass<EdgeShadowPass>(scope);
}

}  // namespace kaamos::effects
