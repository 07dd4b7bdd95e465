// SPDX-License-Identifier: MIT
#include "effects/shadows/screen_space_shadow/screen_space_shadow.h"

#include <shaders/screen_space_shadow.h>

#include <limits>
#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kMostSteps = 1024, kMostMarches = 4;
constexpr float kMostSpread = 16.0f;

template <class T>
rtapi::Status check_range(ErrorId id, const char* what, T value, T least, T most) {
  if (value >= least && value <= most) return {};
  return make_error(id, std::string("ScreenSpaceShadowConstants::") + what + " is " +
                            std::to_string(value) + "; choose " + std::to_string(least) + " to " +
                            std::to_string(most));
}

rtapi::Status check_constants(const ScreenSpaceShadowConstants& c) {
  constexpr float kAny = std::numeric_limits<float>::infinity();
  for (const rtapi::Status& status : {
           check_range(ErrorId::kScreenShadow, "length", c.length, 0.0f, kAny),
           check_range(ErrorId::kScreenShadow, "thickness", c.thickness, 0.0f, kAny),
           check_range(ErrorId::kScreenShadow, "bias", c.bias, -1.0f, 1.0f),
           check_range(ErrorId::kScreenShadow, "border", c.border, 0.0f, 1.0f),
           check_range(ErrorId::kScreenShadow, "spread", c.spread, 0.0f, kMostSpread),
           check_range(ErrorId::kScreenShadowSteps, "steps", c.steps, 1u, kMostSteps),
           check_range(ErrorId::kScreenShadowMarches, "marches", c.marches, 1u, kMostMarches),
           check_range(ErrorId::kScreenShadowMarches, "threshold", c.threshold, 1u, c.marches),
       }) {
    if (!status) return status;
  }
  return {};
}

class ScreenSpaceShadowPass : public EffectPass {
 public:
  ScreenSpaceShadowPass(const EffectScope& scope, ComputePass march)
      : frame_(scope.frame), views_(scope.views), march_(std::move(march)) {}

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    const auto own = settings.get_constants<ScreenSpaceShadowConstants>();
    march_.dispatch(list, frame_, constants, PassArguments(views_, own), frame_.width(),
                    frame_.height());
  }
  std::uint64_t bytes() const override { return 0; }

 private:
  const Frame& frame_;
  PassViews& views_;
  ComputePass march_;
};

}  // namespace

ScreenSpaceShadowConstants multisampled_shadow() {
  return {.spread = 1.0f};
}

ScreenSpaceShadowConstants multipass_shadow() {
  return {.marches = 3, .threshold = 2};
}

rtapi::Result<rtapi::ShaderLibrary> screen_space_shadow_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_screen_space_shadow());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_screen_space_shadow(const EffectScope& scope) {
  const auto constants = scope.settings.get_constants<ScreenSpaceShadowConstants>();
  if (const auto s = check_constants(constants); !s) return s.error();
  auto march = ComputePass::create(scope.device, scope.frame,
                                   scope.library("shadows/screen_space_shadow/screen_space_shadow"),
                                   "ScreenSpaceShadow");
  if (!march) return march.error();
  return std::unique_ptr<EffectPass>(
      std::make_unique<ScreenSpaceShadowPass>(scope, std::move(*march)));
}

}  // namespace kaamos::effects
