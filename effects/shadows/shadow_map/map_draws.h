// SPDX-License-Identifier: MIT
/// @file
/// The scene's depth as the sun sees it, by the rasterizer. [Williams 1978]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <vector>

#include "effects/engine/effect_pass.h"
#include "effects/engine/scene_pipeline.h"
#include "effects/shadows/shadow_map/sun_maps.h"

namespace kaamos::effects {

struct ShadowMapConstants;

/// The pipelines that draw shadow maps, and the maps. Registers t0, t1, t2 and t4 of the pass are
/// its own.
class ShadowMapDraws {
 public:
  /// Makes `count` maps of `size` x `size` texels, with the shaders of shadow_draws.hlsl. The scope
  /// must stay.
  /// @errors those of rtapi::Device::CreateGraphicsPipelineState, on Vulkan KA0965 without graphics
  /// pipelines among them, and of rtapi::Device::CreateTexture.
  rtapi::Status create(const EffectScope& scope, const rtapi::ShaderLibrary& library,
                       std::uint32_t size, std::uint32_t count);

  /// Looks at where the instances are now: what casts shadows is drawn from now on. Left out is
  /// what rays to the sun do not see, lamps among it.
  void see_instances(const glm::dvec3& camera_position);
  /// Around all of it, world space.
  const Bounds& bounds() const { return bounds_; }
  /// Around an instance of it, world space; empty if it casts none.
  Bounds bounds_of(std::uint32_t instance) const;
  /// Sets where the maps are. Precondition: as many as there are maps.
  void set_maps(const std::vector<SunMap>& maps);

  /// Records the draws into all maps, which are shader resources before and behind it.
  void record(rtapi::CommandList& list, const ShadowMapConstants& constants) const;
  /// Bytes of maps and buffers.
  std::uint64_t bytes() const;

 private:
  rtapi::Status create_targets(const rtapi::Device& device);
  rtapi::Status create_buffers(const rtapi::Device& device, const Scene& scene);

  const Frame* frame_ = nullptr;
  const GpuScene* gpu_ = nullptr;
  PassViews* views_ = nullptr;
  std::uint32_t size_ = 0, count_ = 0;
  rtapi::Texture maps_;
  rtapi::DescriptorHeap targets_;
  ScenePipeline pipeline_;
  SceneDrawList draws_;
  rtapi::Buffer map_buffer_;
  std::vector<Bounds> boxes_;  // by instance, object space
  Bounds bounds_;
  glm::dvec3 camera_position_{0.0};
};

}  // namespace kaamos::effects
