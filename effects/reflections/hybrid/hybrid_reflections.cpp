// SPDX-License-Identifier: MIT
#include "effects/reflections/hybrid/hybrid_reflections.h"

#include <shaders/hybrid_reflections.h>

#include <utility>

#include "effects/engine/ray_pass.h"
#include "effects/reflections/traced/reflections.h"

namespace kaamos::effects {

namespace {

class HybridReflections : public EffectPass {
 public:
  HybridReflections(const EffectScope& scope, RayPass pass, rtapi::Buffer masks)
      : frame_(scope.frame),
        views_(scope.views),
        pass_(std::move(pass)),
        masks_(std::move(masks)) {}

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    pass_.dispatch(list, frame_, constants, traced_rows(constants, frame_.height()),
                   PassArguments(views_, settings.constants));
  }
  std::uint64_t bytes() const override { return masks_.size(); }

 private:
  const Frame& frame_;
  const PassViews& views_;
  RayPass pass_;
  rtapi::Buffer masks_;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> hybrid_reflections_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_hybrid_reflections());
}

HybridConstants default_hybrid_constants() {
  HybridConstants constants;
  constants.screen = march_of_pixels();
  constants.screen.strict = 1;
  constants.screen.thickness = 0.02f;
  constants.screen.steps = 1024;
  return constants;
}

rtapi::Result<std::unique_ptr<EffectPass>> make_hybrid_reflections(const EffectScope& scope) {
  const auto constants = scope.settings.get_constants<HybridConstants>();
  if (const auto s = check_screen_reflections(constants.screen); !s) return s.error();
  auto masks = bind_instance_masks(scope);
  if (!masks) return masks.error();
  const auto& library = scope.library("reflections/hybrid/hybrid_reflections");
  auto pass =
      RayPass::create(scope.device, scope.frame, scope.gpu,
                      reflection_shading_pass("hybrid reflections", library, "HybridRayGen"));
  if (!pass) return pass.error();
  return std::unique_ptr<EffectPass>(
      std::make_unique<HybridReflections>(scope, std::move(*pass), std::move(*masks)));
}

}  // namespace kaamos::effects
