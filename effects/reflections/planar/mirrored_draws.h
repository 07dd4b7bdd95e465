// SPDX-License-Identifier: MIT
/// @file
/// Draws of the scene that a plane mirrors: which triangle each texel of its picture shows.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/engine/effect_pass.h"
#include "effects/engine/scene_pipeline.h"

namespace kaamos::effects {

/// A visibility buffer of a plane's size, which every plane takes in turn.
class MirroredDraws {
 public:
  /// Makes pipelines of the library's shaders and targets of that size. The scope's views get t7 to
  /// t9.
  /// @errors those of ScenePipeline::create, SceneDrawList::create and of the device.
  static rtapi::Result<MirroredDraws> create(const EffectScope& scope,
                                             const rtapi::ShaderLibrary& library,
                                             std::uint32_t width, std::uint32_t height);
  /// Their part of EffectPass::begin_frame.
  void begin_frame(const Camera& camera);
  /// PlanarConstants::clip_scale.
  float clip_scale() const { return clip_scale_; }
  /// Records the draws of the plane that `arguments` name.
  void record(rtapi::CommandList& list, const Frame& frame, const PassArguments& arguments) const;
  /// Bytes of the targets and of the list of draws.
  std::uint64_t bytes() const;

 private:
  rtapi::Status create_targets(const rtapi::Device& device);

  std::uint32_t width_ = 0, height_ = 0;
  ScenePipeline pipeline_;
  SceneDrawList draws_;
  ClipDepth clip_depth_;
  float clip_scale_ = 0;
  rtapi::Texture visibility_, depth_;
  rtapi::DescriptorHeap target_heap_, depth_heap_;
};

}  // namespace kaamos::effects
