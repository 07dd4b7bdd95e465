// SPDX-License-Identifier: MIT
/// @file
/// The second layer of depth of a frame, by peeling. [Everitt 2001; Mara et al. 2016]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/engine/effect_pass.h"
#include "effects/engine/scene_pipeline.h"

namespace kaamos::effects {

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> second_layer_library();

/// Draws what lies behind the first surface of each pixel. Registers t0, t1 and t4 of the pass are
/// its own: t4 is the view depth, metres; 0: nothing is there.
class SecondLayer {
 public:
  /// Makes pipelines and pictures. The scope must stay.
  /// @errors those of rtapi::Device::CreateGraphicsPipelineState, on Vulkan KA0965 without graphics
  /// pipelines among them, and of rtapi::Device::CreateTexture.
  static rtapi::Result<SecondLayer> create(const EffectScope& scope,
                                           const rtapi::ShaderLibrary& library);
  /// Looks at where camera and instances are now.
  void begin_frame(const Camera& camera);
  /// Records the draws, behind the G-buffer. What is `separation` metres behind the first surface,
  /// or less, is part of it.
  void record(rtapi::CommandList& list, float separation) const;
  /// Bytes of pictures and buffers.
  std::uint64_t bytes() const;

 private:
  rtapi::Status create_targets(const rtapi::Device& device);

  const Frame* frame_ = nullptr;
  PassViews* views_ = nullptr;
  ClipDepth clip_depth_;
  float clip_scale_ = 0;
  ScenePipeline pipeline_;
  SceneDrawList draws_;
  rtapi::Texture view_z_, depth_;
  rtapi::DescriptorHeap render_targets_, depth_targets_;
};

}  // namespace kaamos::effects
