// SPDX-License-Identifier: MIT
#include "effects/reflections/blurred/blurred_reflections.h"

#include <shaders/blurred_reflections.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "effects/engine/compute_pass.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kLevels = 5;  // as in blurred_reflections.hlsl
constexpr std::uint32_t kRays = 1, kBefore = 2, kMirrored = 3, kMips = 4;  // u, space3

std::uint32_t level_size(std::uint32_t size, std::uint32_t level) {
  return std::max((size + (1u << level) - 1) >> level, 1u);
}

class BlurredReflections : public EffectPass {
 public:
  explicit BlurredReflections(const EffectScope& scope)
      : device_(scope.device), frame_(scope.frame), views_(scope.views) {}

  rtapi::Status create(const EffectScope& scope) {
    const auto constants = scope.settings.get_constants<BlurredConstants>();
    auto inputs = ScreenInputs::create(scope, constants.screen);
    if (!inputs) return inputs.error();
    inputs_ = std::move(*inputs);
    const auto& library = scope.library("reflections/blurred/blurred_reflections");
    constexpr const char* kEntries[] = {"SendMirrorRays", "GatherMirrorRays", "BlurLevel",
                                        "BlurMirrored"};
    ComputePass* const passes[] = {&send_, &gather_, &level_, &blur_};
    for (std::size_t i = 0; i < std::size(kEntries); ++i) {
      auto pass = ComputePass::create(device_, frame_, library, kEntries[i]);
      if (!pass) return pass.error();
      *passes[i] = std::move(*pass);
    }
    if (const auto s = create_pictures(); !s) return s;
    return {};
  }

  rtapi::Status begin_frame(const Camera& camera) override {
    if (is_recorded_) {
      newest_ = 1 - newest_;
      has_history_ = true;
      if (const auto s = bind_history(); !s) return s;
    }
    is_recorded_ = false;
    return inputs_.begin_frame(camera);
  }

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    auto words = settings.get_constants<BlurredConstants>();
    words.has_history = has_history_ ? 1 : 0;
    const std::uint32_t width = frame_.width(), height = frame_.height();
    const auto run = [&](const ComputePass& pass, std::uint32_t level) {
      words.level = level;
      pass.dispatch(list, frame_, constants, PassArguments(views_, words), level_size(width, level),
                    level_size(height, level));
    };
    run(send_, 1);
    run(gather_, 0);
    for (std::uint32_t level = 1; level <= kLevels; ++level) run(level_, level);
    run(blur_, 0);
    is_recorded_ = true;
  }

  std::uint64_t bytes() const override {
    return picture_bytes(rays_) + picture_bytes(mips_) + picture_bytes(mirrored_[0]) +
           picture_bytes(mirrored_[1]) + inputs_.bytes();
  }

 private:
  rtapi::Status create_pictures() {
    const std::uint32_t width = frame_.width(), height = frame_.height();
    std::uint32_t mips_width = 0;
    for (std::uint32_t level = 1; level <= kLevels; ++level) mips_width += level_size(width, level);
    const auto create = [&](rtapi::Texture& picture, const char* name, std::uint32_t w,
                            std::uint32_t h) -> rtapi::Status {
      const auto created = create_picture(device_, name, rtapi::Format::kR32G32B32A32Float, w, h);
      if (!created) return created.error();
      picture = *created;
      return {};
    };
    const std::uint32_t half_width = level_size(width, 1), half_height = level_size(height, 1);
    if (const auto s = create(rays_, "mirror rays", half_width, half_height); !s) return s;
    if (const auto s = create(mips_, "mirrored mips", mips_width, half_height); !s) return s;
    for (rtapi::Texture& each : mirrored_) {
      if (const auto s = create(each, "mirrored", width, height); !s) return s;
    }
    if (const auto s = views_.set_unordered_access(kRays, rays_); !s) return s;
    if (const auto s = views_.set_unordered_access(kMips, mips_); !s) return s;
    return bind_history();
  }

  rtapi::Status bind_history() {
    const auto s = views_.set_unordered_access(kBefore, mirrored_[1 - newest_]);
    if (!s) return s;
    return views_.set_unordered_access(kMirrored, mirrored_[newest_]);
  }

  const rtapi::Device& device_;
  const Frame& frame_;
  PassViews& views_;
  ComputePass send_, gather_, level_, blur_;
  rtapi::Texture rays_, mips_, mirrored_[2];
  ScreenInputs inputs_;
  std::uint32_t newest_ = 0;  // of mirrored_: what this frame writes
  bool is_recorded_ = false, has_history_ = false;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> blurred_reflections_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_blurred_reflections());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_blurred_reflections(const EffectScope& scope) {
  return make_pass<BlurredReflections>(scope);
}

}  // namespace kaamos::effects
