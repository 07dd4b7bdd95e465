// SPDX-License-Identifier: MIT
#include "effects/shadows/hybrid_shadow/hybrid_shadow.h"

#include <shaders/hybrid_shadow.h>

#include <string>

#include "effects/assets/common/errors.h"
#include "effects/shadows/shadow_map/map_rays.h"

namespace kaamos::effects {
namespace {

rtapi::Status check_hybrid(const HybridShadowConstants& constants) {
  if (const auto s = check_shadow_map(constants.map); !s) return s;
  if (constants.soft_from >= 0.0f && constants.soft_from <= 1e9f) return {};
  return make_error(ErrorId::kHybridShadow, "HybridShadowConstants::soft_from is " +
                                                std::to_string(constants.soft_from) +
                                                "; choose 0 to 1e9 metres");
}

class HybridShadowPass : public MapRays {
 public:
  using MapRays::MapRays;

  rtapi::Status create(const EffectScope& scope) {
    const auto constants = scope.settings.get_constants<HybridShadowConstants>();
    if (const auto s = check_hybrid(constants); !s) return s;
    return MapRays::create(
        scope, occluder_pass("hybrid shadow", scope.library("shadows/hybrid_shadow/hybrid_shadow"),
                             "HybridShadowRayGen"));
  }
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> hybrid_shadow_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_hybrid_shadow());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_hybrid_shadow(const EffectScope& scope) {
  return make_pass<HybridShadowPass>(scope);
}

}  // namespace kaamos::effects
