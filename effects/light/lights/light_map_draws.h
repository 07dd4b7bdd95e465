// SPDX-License-Identifier: MIT
/// @file
/// The atlas of shadow maps by the rasterizer instead of by rays. [Northlight deck: Lighting Data]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "effects/assets/scene/light_constants.h"
#include "effects/engine/frame.h"
#include "effects/engine/scene_pipeline.h"

namespace kaamos::effects {

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> light_map_draws_library();

/// Draws every texel of the atlas that a ray renders otherwise, with the same meaning. What a texel
/// sees may differ at the very edge of triangles alone.
class LightMapDraws {
 public:
  /// Makes the pipelines for an atlas that may be a render target. Registers t0 and t1 of `views`
  /// are its own. All but the library must stay.
  /// @errors those of rtapi::Device::CreateGraphicsPipelineState, on Vulkan KA0965 without graphics
  /// pipelines among them, and of rtapi::Device::CreateTexture.
  rtapi::Status create(const rtapi::Device& device, const Frame& frame, const Scene& scene,
                       const GpuScene& gpu, const rtapi::ShaderLibrary& library,
                       const AtlasLayout& layout, const rtapi::Texture& atlas, PassViews& views);

  /// Looks at where instances and lights are now. What a light does not reach is not drawn for it.
  void see(const glm::dvec3& camera_position);
  /// Records the draws, between unordered-access states of the atlas. `views` are those of create.
  void record(rtapi::CommandList& list, const PassViews& views) const;
  /// Bytes of its depth buffer and lists.
  std::uint64_t bytes() const;

 private:
  rtapi::Status create_targets(const rtapi::Device& device);
  void record_face(rtapi::CommandList& list, std::uint32_t light, std::uint32_t face,
                   const std::vector<std::uint32_t>& draws) const;
  std::vector<std::uint32_t> draws_near(const LightConstants& light) const;

  const Frame* frame_ = nullptr;
  const Scene* scene_ = nullptr;
  AtlasLayout layout_;
  rtapi::Texture atlas_, depth_;
  rtapi::DescriptorHeap target_, depth_target_;
  ScenePipeline pipeline_;
  SceneDrawList draws_;
  std::vector<Bounds> boxes_;  // by instance, object space
  std::vector<LightConstants> lights_;
};

}  // namespace kaamos::effects
