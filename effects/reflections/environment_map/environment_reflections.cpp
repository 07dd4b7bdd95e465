// SPDX-License-Identifier: MIT
#include <shaders/environment_reflections.h>

#include <utility>

#include "effects/engine/compute_pass.h"
#include "effects/reflections/environment_map/environment_map.h"

namespace kaamos::effects {

namespace {

class EnvironmentReflections : public EffectPass {
 public:
  EnvironmentReflections(const EffectScope& scope, EnvironmentMap map, ComputePass pass)
      : device_(scope.device),
        frame_(scope.frame),
        views_(scope.views),
        map_(std::move(map)),
        pass_(std::move(pass)) {}

  rtapi::Status begin_frame(const Camera& camera) override {
    return map_.set_origin(device_, camera.position(), views_);
  }
  void record(rtapi::CommandList& list, const EffectSettings&,
              const PassConstants& constants) override {
    pass_.dispatch(list, frame_, constants, PassArguments(views_), frame_.width(), frame_.height());
  }
  std::uint64_t bytes() const override { return map_.bytes(); }

 private:
  const rtapi::Device& device_;
  const Frame& frame_;
  PassViews& views_;
  EnvironmentMap map_;
  ComputePass pass_;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> environment_reflections_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_environment_reflections());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_environment_reflections(const EffectScope& scope) {
  auto map = EnvironmentMap::of_scene(scope, scope.settings.get_constants<EnvironmentConstants>());
  if (!map) return map.error();
  auto pass =
      ComputePass::create(scope.device, scope.frame,
                          scope.library("reflections/environment_map/environment_reflections"),
                          "EnvironmentReflections");
  if (!pass) return pass.error();
  return std::unique_ptr<EffectPass>(
      std::make_unique<EnvironmentReflections>(scope, std::move(*map), std::move(*pass)));
}

}  // namespace kaamos::effects
