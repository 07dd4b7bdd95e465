// SPDX-License-Identifier: MIT
#include "effects/reflections/stochastic/stochastic_reflections.h"

#include <shaders/stochastic_reflections.h>

#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

namespace {

rtapi::Status check(const StochasticConstants& constants) {
  const std::uint32_t n = constants.neighbours;
  if (n != 1 && n != 4 && n != 9) {
    return make_error(ErrorId::kScreenReflections,
                      "a pixel takes " + std::to_string(n) + " neighbours' rays; choose 1, 4 or 9");
  }
  if (!(constants.tail > 0 && constants.tail <= 1)) {
    return make_error(ErrorId::kScreenReflections, "directions are drawn from " +
                                                       std::to_string(constants.tail) +
                                                       " of the lobe; choose more than 0, up to 1");
  }
  return {};
}

class StochasticReflections : public EffectPass {
 public:
  explicit StochasticReflections(const EffectScope& scope)
      : device_(scope.device),
        frame_(scope.frame),
        views_(scope.views),
        width_((scope.frame.width() + 1) / 2),
        height_((scope.frame.height() + 1) / 2) {}

  rtapi::Status create(const EffectScope& scope) {
    const auto constants = scope.settings.get_constants<StochasticConstants>();
    auto inputs = ScreenInputs::create(scope, constants.screen);
    if (!inputs) return inputs.error();
    inputs_ = std::move(*inputs);
    if (const auto s = check(constants); !s) return s;
    const auto& library = scope.library("reflections/stochastic/stochastic_reflections");
    auto send = ComputePass::create(device_, frame_, library, "SendRays");
    if (!send) return send.error();
    send_ = std::move(*send);
    auto resolve = ComputePass::create(device_, frame_, library, "ResolveRays");
    if (!resolve) return resolve.error();
    resolve_ = std::move(*resolve);
    for (std::uint32_t i = 0; i < 2; ++i) {
      const auto picture = create_picture(device_, i == 0 ? "ray hits" : "ray light",
                                          rtapi::Format::kR32G32B32A32Float, width_, height_);
      if (!picture) return picture.error();
      pictures_[i] = *picture;
      if (const auto s = views_.set_unordered_access(1 + i, pictures_[i]); !s) return s;
    }
    return {};
  }

  rtapi::Status begin_frame(const Camera& camera) override { return inputs_.begin_frame(camera); }

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    const PassArguments arguments(views_, settings.constants);
    PassConstants one = constants;
    one.sample_count = 1;
    for (std::uint32_t i = 0; i < constants.sample_count; ++i) {
      one.first_sample = constants.first_sample + i;
      one.accumulate = i == 0 ? constants.accumulate : 1;
      send_.dispatch(list, frame_, one, arguments, width_, height_);
      resolve_.dispatch(list, frame_, one, arguments, frame_.width(), frame_.height());
    }
  }

  std::uint64_t bytes() const override {
    return picture_bytes(pictures_[0]) + picture_bytes(pictures_[1]) + inputs_.bytes();
  }

 private:
  const rtapi::Device& device_;
  const Frame& frame_;
  PassViews& views_;
  std::uint32_t width_, height_;  // of the rays
  ComputePass send_, resolve_;
  rtapi::Texture pictures_[2];
  ScreenInputs inputs_;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> stochastic_reflections_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_stochastic_reflections());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_stochastic_reflections(const EffectScope& scope) {
  return make_pass<StochasticReflections>(scope);
}

}  // namespace kaamos::effects
