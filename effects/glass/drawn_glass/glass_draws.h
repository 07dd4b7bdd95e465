// SPDX-License-Identifier: MIT
/// @file
/// What techniques share that draw glass: the sorted list of draws, rays for the mirror image of
/// the nearest layer, and an environment map for those of all others.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "effects/engine/effect_pass.h"
#include "effects/engine/scene_pipeline.h"
#include "effects/glass/drawn_glass/drawn_glass.h"
#include "effects/reflections/environment_map/environment_map.h"

namespace kaamos::effects {

/// Registers u2, t7 and t8 of the pass are its own, and those of the environment map.
class GlassDraws {
 public:
  /// Makes all of it for a pass with these constants. The scope must stay.
  /// @errors those of EnvironmentMap::create and of RayPass::create; those of the device.
  rtapi::Status create(const EffectScope& scope, const DrawnGlassConstants& constants);

  /// Sorts the draws: far ones come first. What cannot be sorted by the middle of its box is in a
  /// wrong order.
  /// @errors those of EnvironmentMap::set_origin.
  rtapi::Status begin_frame(const Camera& camera);
  /// Sets the words of the constants that the pass knows.
  void set_words(DrawnGlassConstants& words) const;

  /// Records the rays to the nearest layer; none where no layer would show their mirror image.
  void record_rays(rtapi::CommandList& list, const PassConstants& constants,
                   const PassArguments& arguments, const DrawnGlassConstants& words) const;
  /// Records the draws with each of the pipelines, draw by draw.
  void record(rtapi::CommandList& list, const std::vector<rtapi::PipelineState>& pipelines) const;

  /// The part of a pipeline's description that all of these draws share.
  rtapi::GraphicsPipelineStateDesc describe(const rtapi::ShaderLibrary& library,
                                            const char* pixel_shader) const;
  /// Bytes of pictures and buffers.
  std::uint64_t bytes() const;

 private:
  const Frame* frame_ = nullptr;
  const GpuScene* gpu_ = nullptr;
  RayPass rays_;
  rtapi::Texture mirrored_;
  std::vector<glm::dvec3> centres_;  // of instances' boxes, object space
  SceneDrawList draws_;
  EnvironmentFallback environment_;
  ClipDepth clip_depth_;
  float clip_scale_ = 0;
};

}  // namespace kaamos::effects
