// SPDX-License-Identifier: MIT
#include "effects/shadows/adaptive_shadow/adaptive_shadow.h"

#include <shaders/adaptive_shadow.h>

#include <string>
#include <utility>

#include "effects/engine/picture.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kTile = 64;  // of adaptive_shadow.hlsl

std::uint32_t tiles(std::uint32_t pixels) {
  return (pixels + kTile - 1) / kTile;
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> adaptive_shadow_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_adaptive_shadow());
}

rtapi::Status AdaptiveShadowPass::create_pictures(const EffectScope& scope) {
  // From register u2 on.
  constexpr const char* kNames[] = {"visibility before", "visibility",    "variation before",
                                    "variation",         "counts before", "counts",
                                    "view z before",     "work",          "other"};
  std::uint32_t u = 2;
  for (const char* name : kNames) {
    const bool is_depth = u == 8;
    const auto picture = frame_.create_picture(
        scope.device, std::string("adaptive shadow ") + name,
        is_depth ? rtapi::Format::kR32Float : rtapi::Format::kR32G32B32A32Float);
    if (!picture) return picture.error();
    pictures_.push_back(*picture);
    bytes_ += picture_bytes(*picture);
    if (const auto s = views_.set_unordered_access(u++, *picture); !s) return s;
  }
  rtapi::BufferDesc desc;
  desc.Name = "adaptive shadow sums";
  desc.SizeInBytes = sizeof(float) * (tiles(frame_.width()) * tiles(frame_.height()) + 1);
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  const auto sums = scope.device.CreateBuffer(desc);
  if (!sums) return sums.error();
  sums_ = *sums;
  bytes_ += desc.SizeInBytes;
  return views_.set_unordered_access(u, sums_, sizeof(float));
}

rtapi::Result<std::unique_ptr<EffectPass>> AdaptiveShadowPass::create(const EffectScope& scope) {
  std::unique_ptr<AdaptiveShadowPass> out(new AdaptiveShadowPass(scope));
  const rtapi::ShaderLibrary& library = scope.library("shadows/adaptive_shadow/adaptive_shadow");
  RayPassDesc desc;
  desc.name = "adaptive shadow";
  desc.library = library;
  desc.ray_generation = "AdaptiveShadowRayGen";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 4;  // VisibilityPayload
  const auto rays = RayPass::create(scope.device, scope.frame, scope.gpu, desc);
  if (!rays) return rays.error();
  out->rays_ = *rays;
  const auto add = [&](const char* entry_point, ComputePass& pass) -> rtapi::Status {
    const auto made = ComputePass::create(scope.device, scope.frame, library, entry_point);
    if (!made) return made.error();
    pass = *made;
    return {};
  };
  out->before_rays_.resize(5);
  out->after_rays_.resize(2);
  const std::pair<const char*, ComputePass*> passes[] = {
      {"Reproject", &out->before_rays_[0]},
      {"MaxAcross", &out->before_rays_[1]},
      {"MaxDown", &out->before_rays_[2]},
      {"LowPassAcross", &out->before_rays_[3]},
      {"LowPassDown", &out->before_rays_[4]},
      {"SumTiles", &out->sum_tiles_},
      {"SumAll", &out->sum_all_},
      {"SmoothAcross", &out->after_rays_[0]},
      {"SmoothDown", &out->after_rays_[1]},
  };
  for (const auto& [entry_point, pass] : passes) {
    if (const auto s = add(entry_point, *pass); !s) return s.error();
  }
  if (const auto s = out->create_pictures(scope); !s) return s.error();
  return std::unique_ptr<EffectPass>(std::move(out));
}

void AdaptiveShadowPass::record(rtapi::CommandList& list, const EffectSettings& settings,
                                const PassConstants& given) {
  auto own = settings.get_constants<AdaptiveShadowConstants>();
  own.frame_count = frame_count_++;
  PassConstants constants = given;
  constants.pixel_step = 1;
  const PassArguments arguments(views_, own);
  const std::uint32_t width = frame_.width(), height = frame_.height();
  for (const ComputePass& pass : before_rays_) {
    pass.dispatch(list, frame_, constants, arguments, width, height);
  }
  if (own.budget > 0.0f) {
    sum_tiles_.dispatch_groups(list, frame_, constants, arguments, tiles(width), tiles(height));
    sum_all_.dispatch_groups(list, frame_, constants, arguments, 1, 1);
  }
  rays_.dispatch(list, frame_, constants, height, arguments);
  for (const ComputePass& pass : after_rays_) {
    pass.dispatch(list, frame_, constants, arguments, width, height);
  }
}

}  // namespace kaamos::effects
