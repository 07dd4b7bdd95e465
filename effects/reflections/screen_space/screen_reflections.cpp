// SPDX-License-Identifier: MIT
#include "effects/reflections/screen_space/screen_reflections.h"

#include <shaders/screen_reflections.h>

#include <string>
#include <utility>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kInstanceMasks = 4;  // register t, space3

class ScreenReflections : public EffectPass {
 public:
  explicit ScreenReflections(const EffectScope& scope) : frame_(scope.frame), views_(scope.views) {}

  rtapi::Status create(const EffectScope& scope) {
    auto inputs =
        ScreenInputs::create(scope, scope.settings.get_constants<ScreenReflectionConstants>());
    if (!inputs) return inputs.error();
    inputs_ = std::move(*inputs);
    auto pass = ComputePass::create(scope.device, scope.frame,
                                    scope.library("reflections/screen_space/screen_reflections"),
                                    "ScreenReflections");
    if (!pass) return pass.error();
    pass_ = std::move(*pass);
    return {};
  }

  rtapi::Status begin_frame(const Camera& camera) override { return inputs_.begin_frame(camera); }
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    const std::uint32_t columns = traced_columns(constants, frame_.width());
    const std::uint32_t rows = traced_rows(constants, frame_.height());
    if (columns == 0 || rows == 0) return;
    pass_.dispatch(list, frame_, constants, PassArguments(views_, settings.constants), columns,
                   rows);
  }
  std::uint64_t bytes() const override { return inputs_.bytes(); }

 private:
  const Frame& frame_;
  PassViews& views_;
  ComputePass pass_;
  ScreenInputs inputs_;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> screen_reflections_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_screen_reflections());
}

rtapi::Result<rtapi::Buffer> bind_instance_masks(const EffectScope& scope) {
  std::vector<std::uint32_t> masks;
  for (const Instance& instance : scope.scene.instances) masks.push_back(instance.mask);
  if (masks.empty()) masks.push_back(0);
  auto buffer = rtapi::CreateUploadBuffer(scope.device, masks, "instance masks");
  if (!buffer) return buffer.error();
  const auto s = scope.views.set_shader_resource(kInstanceMasks, *buffer, sizeof(std::uint32_t));
  if (!s) return s.error();
  return buffer;
}

rtapi::Status check_screen_reflections(const ScreenReflectionConstants& constants) {
  if (constants.steps == 0 || constants.steps > kMostScreenSteps) {
    return make_error(ErrorId::kScreenReflections,
                      "a ray takes " + std::to_string(constants.steps) + " samples; choose 1 to " +
                          std::to_string(kMostScreenSteps));
  }
  if (constants.refinements > kMostScreenRefinements) {
    return make_error(ErrorId::kScreenReflections,
                      "a step is halved " + std::to_string(constants.refinements) +
                          " times; choose at most " + std::to_string(kMostScreenRefinements));
  }
  if (!(constants.stride >= 1.0f) || constants.march > ScreenMarch::kLine ||
      constants.source > ScreenSource::kPreviousFrame ||
      constants.fallback > ScreenFallback::kEnvironment) {
    return make_error(ErrorId::kScreenReflections,
                      "the stride is " + std::to_string(constants.stride) +
                          " pixels and has to be at least 1; march, source and fallback are values "
                          "of their enumerations");
  }
  return {};
}

ScreenReflectionConstants march_of_metres() {
  ScreenReflectionConstants constants;
  constants.march = ScreenMarch::kMetres;
  constants.longest = 20.0f;
  constants.steps = 64;
  constants.refinements = 6;
  constants.step_thickness = 1.0f;
  return constants;
}

ScreenReflectionConstants march_of_pixels() {
  return {};
}

ScreenReflectionConstants march_of_line() {
  ScreenReflectionConstants constants;
  constants.march = ScreenMarch::kLine;
  constants.longest = constants.shortest = 1e30f;
  constants.length_jitter = 0;
  constants.steps = 32;
  constants.edge_fade = 0;
  constants.fallback = ScreenFallback::kNone;
  return constants;
}

rtapi::Result<ScreenInputs> ScreenInputs::create(const EffectScope& scope,
                                                 const ScreenReflectionConstants& constants) {
  if (const auto s = check_screen_reflections(constants); !s) return s.error();
  ScreenInputs out;
  auto masks = bind_instance_masks(scope);
  if (!masks) return masks.error();
  out.masks_ = std::move(*masks);
  auto environment =
      EnvironmentFallback::create(scope, constants.fallback == ScreenFallback::kEnvironment);
  if (!environment) return environment.error();
  out.environment_ = std::move(*environment);
  return out;
}

rtapi::Result<std::unique_ptr<EffectPass>> make_screen_reflections(const EffectScope& scope) {
  return make_pass<ScreenReflections>(scope);
}

}  // namespace kaamos::effects
