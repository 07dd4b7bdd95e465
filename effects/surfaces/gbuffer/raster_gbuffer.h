// SPDX-License-Identifier: MIT
/// @file
/// The G-buffer by the rasterizer: a visibility buffer, and a compute pass that makes the same
/// pictures of it as primary rays do. [Burns & Hunt 2013]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/engine/scene_pipeline.h"

namespace kaamos::effects {

/// The shaders of raster.hlsl and of resolve.hlsl.
struct RasterLibraries {
  rtapi::ShaderLibrary raster;   ///< vertex and pixel shaders
  rtapi::ShaderLibrary resolve;  ///< the compute shader
};
/// RasterLibraries::raster as it is built into the program.
/// @errors KA0910 it was made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> raster_library();
/// RasterLibraries::resolve as it is built into the program.
/// @errors KA0910 it was made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> resolve_library();

/// Both passes, and the pictures between them.
class RasterGBuffer {
 public:
  /// Makes pipelines and pictures. `gpu` is `scene` on the device and must stay.
  /// @errors those of rtapi::Device::CreateGraphicsPipelineState, on Vulkan KA0965 without graphics
  /// pipelines among them; those of ComputePass::create, Frame::create_pass_views and
  /// rtapi::Device::CreateTexture.
  static rtapi::Result<RasterGBuffer> create(const rtapi::Device& device, const Frame& frame,
                                             const Scene& scene, const GpuScene& gpu,
                                             const RasterLibraries& libraries);

  /// Records the draws of the scene as it stands now in GpuScene::instances: visibility() and
  /// depth() are written. The list of the frame before must have finished: what the device reads is
  /// written now. The camera is the frame's.
  void record_draws(rtapi::CommandList& list, const Frame& frame, const Camera& camera);
  /// Records what makes the frame's pictures of visibility(): all that gbuffer_pass writes.
  void record_resolve(rtapi::CommandList& list, const Frame& frame) const;

  /// R32G32_UINT, a non-pixel shader resource between frames: draw + 1 and primitive; 0: nothing.
  const rtapi::Texture& visibility() const { return visibility_; }
  /// R32_TYPELESS, drawn as D32_FLOAT and a non-pixel shader resource between frames:
  /// [ClipDepth]; 0: nothing.
  const rtapi::Texture& depth() const { return depth_; }
  /// The draws of the last record_draws; visibility() counts them.
  const std::vector<SceneDraw>& draws() const { return draws_.draws(); }
  /// Bytes of both pictures and of the draws.
  std::uint64_t bytes() const;

 private:
  rtapi::Status create_targets(const rtapi::Device& device, const Frame& frame);

  rtapi::Texture visibility_, depth_;
  rtapi::DescriptorHeap render_targets_, depth_targets_;
  ScenePipeline pipeline_;
  ComputePass resolve_;
  PassViews views_;
  ClipDepth clip_depth_;
  float clip_scale_ = 0;
  SceneDrawList draws_;
};

}  // namespace kaamos::effects
