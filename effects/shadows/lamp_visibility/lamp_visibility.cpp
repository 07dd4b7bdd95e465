// SPDX-License-Identifier: MIT
#include "effects/shadows/lamp_visibility/lamp_visibility.h"

#include <shaders/lamp_visibility.h>

#include <utility>

#include "effects/engine/compute_pass.h"
#include "effects/engine/picture.h"
#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

namespace {

constexpr const char* kLibrary = "shadows/lamp_visibility/lamp_visibility";

RayPassDesc ray_pass(const rtapi::ShaderLibrary& library) {
  RayPassDesc desc;
  desc.name = "visibility of local lights";
  desc.library = library;
  desc.ray_generation = "LampVisibilityRayGen";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  return desc;
}

class LampVisibilityPass : public EffectPass {
 public:
  explicit LampVisibilityPass(const EffectScope& scope)
      : frame_(scope.frame), views_(scope.views) {}

  rtapi::Status create(const EffectScope& scope) {
    const auto bits =
        frame_.create_picture(scope.device, "visible lights", rtapi::Format::kR32G32B32A32Uint);
    if (!bits) return bits.error();
    bits_ = *bits;
    if (const auto s = views_.set_unordered_access(1, bits_); !s) return s;
    const rtapi::ShaderLibrary& library = scope.library(kLibrary);
    auto rays = RayPass::create(scope.device, frame_, scope.gpu, ray_pass(library));
    if (!rays) return rays.error();
    rays_ = std::move(*rays);
    const auto shade = ComputePass::create(scope.device, frame_, library, "LightByVisibility");
    if (!shade) return shade.error();
    shade_ = *shade;
    return {};
  }

  void record(rtapi::CommandList& list, const EffectSettings&,
              const PassConstants& constants) override {
    rays_.dispatch(list, frame_, constants, frame_.height(), PassArguments(views_));
    shade_.dispatch(list, frame_, constants, PassArguments(views_), frame_.width(),
                    frame_.height());
  }
  std::uint64_t bytes() const override { return picture_bytes(bits_); }

 private:
  const Frame& frame_;
  PassViews& views_;
  rtapi::Texture bits_;
  RayPass rays_;
  ComputePass shade_;
};

}  // namespace

rtapi::Result<std::unique_ptr<EffectPass>> make_lamp_visibility(const EffectScope& scope) {
  return make_pass<LampVisibilityPass>(scope);
}

rtapi::Result<rtapi::ShaderLibrary> lamp_visibility_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_lamp_visibility());
}

}  // namespace kaamos::effects
