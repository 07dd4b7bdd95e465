// SPDX-License-Identifier: MIT
#include "effects/shadows/hybrid_shadow/hybrid_shadow.h"

#include <shaders/hybrid_shadow.h>

#include <algorithm>
#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/ray_pass.h"
#include "effects/shadows/shadow_map/map_draws.h"

namespace kaamos::effects {
namespace {

RayPassDesc hybrid_shadow_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "hybrid shadow";
  desc.library = std::move(library);
  desc.ray_generation = "HybridShadowRayGen";
  desc.miss[kRayTypeVisibility] = "OccluderMiss";
  desc.hit[kRayTypeVisibility].any_hit = "OccluderAnyHit";
  desc.hit[kRayTypeVisibility].closest_hit = "OccluderClosestHit";
  desc.payload_bytes = 8;  // OccluderPayload
  return desc;
}

rtapi::Status check_hybrid(const HybridShadowConstants& constants) {
  if (const auto s = check_shadow_map(constants.map); !s) return s;
  if (constants.soft_from >= 0.0f && constants.soft_from <= 1e9f) return {};
  return make_error(ErrorId::kHybridShadow, "HybridShadowConstants::soft_from is " +
                                                std::to_string(constants.soft_from) +
                                                "; choose 0 to 1e9 metres");
}

class HybridShadowPass : public EffectPass {
 public:
  explicit HybridShadowPass(const EffectScope& scope)
      : frame_(scope.frame),
        scene_(scope.scene),
        views_(scope.views),
        made_(scope.settings.get_constants<HybridShadowConstants>()) {}

  rtapi::Status create(const EffectScope& scope) {
    if (const auto s = check_hybrid(made_); !s) return s;
    const auto& draws = scope.library("shadows/shadow_map/shadow_draws");
    if (const auto s = draws_.create(scope, draws, made_.map.size, map_count()); !s) return s;
    const auto disk = bind_disk(scope);
    if (!disk) return disk.error();
    disk_ = *disk;
    auto rays =
        RayPass::create(scope.device, frame_, scope.gpu,
                        hybrid_shadow_pass(scope.library("shadows/hybrid_shadow/hybrid_shadow")));
    if (!rays) return rays.error();
    rays_ = std::move(*rays);
    return {};
  }

  rtapi::Status begin_frame(const Camera& camera) override {
    draws_.see_instances(camera.position());
    draws_.set_maps(
        sun_maps(describe_sun_maps(made_.map, scene_, draws_.bounds(), frame_), camera));
    return {};
  }

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    auto own = settings.get_constants<HybridShadowConstants>();
    own.map.size = made_.map.size;
    own.map.cascades = map_count();
    draws_.record(list, own.map);
    rays_.dispatch(list, frame_, constants, frame_.height(), PassArguments(views_, own));
  }

  std::uint64_t bytes() const override { return draws_.bytes() + disk_.size(); }

 private:
  std::uint32_t map_count() const { return std::max(made_.map.cascades, 1u); }

  const Frame& frame_;
  const Scene& scene_;
  PassViews& views_;
  const HybridShadowConstants made_;
  ShadowMapDraws draws_;
  rtapi::Buffer disk_;
  RayPass rays_;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> hybrid_shadow_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_hybrid_shadow());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_hybrid_shadow(const EffectScope& scope) {
  return make_pass<HybridShadowPass>(scope);
}

}  // namespace kaamos::effects
