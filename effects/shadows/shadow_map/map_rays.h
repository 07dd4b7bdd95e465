// SPDX-License-Identifier: MIT
/// @file
/// Rays from shaders that read the sun's maps, which are drawn before. [shadow_map.hlsli]
#pragma once

#include <rtapi/rtapi.h>

#include "effects/engine/effect_pass.h"
#include "effects/engine/ray_pass.h"
#include "effects/shadows/shadow_map/map_draws.h"
#include "effects/shadows/shadow_map/shadow_map.h"

namespace kaamos::effects {

/// One ray tracing pass over the picture behind the draws of its maps. Its constants begin with
/// ShadowMapConstants.
class MapRays : public EffectPass {
 public:
  /// The scope must stay.
  explicit MapRays(const EffectScope& scope);
  /// Makes maps and pass. The row has shadow_draws_library().
  /// @errors KA3060 a constant of the maps out of its range; KA0965 on Vulkan without graphics
  /// pipelines; those of RayPass::create; others of the device.
  rtapi::Status create(const EffectScope& scope, const RayPassDesc& rays);

  /// Places the maps.
  /// @errors those of EffectPass::begin_frame.
  rtapi::Status begin_frame(const Camera& camera) override;
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override;
  std::uint64_t bytes() const override { return draws_.bytes() + disk_.size(); }

 private:
  const Frame& frame_;
  const Scene& scene_;
  PassViews& views_;
  ShadowMapConstants made_;
  ShadowMapDraws draws_;
  rtapi::Buffer disk_;
  RayPass rays_;
};

/// The shaders of OccluderPayload's rays [occluder.hlsli], for a pass of that name.
RayPassDesc occluder_pass(const char* name, rtapi::ShaderLibrary library,
                          const char* ray_generation);

}  // namespace kaamos::effects
