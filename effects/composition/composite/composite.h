// SPDX-License-Identifier: MIT
/// @file
/// Computes the frame's radiance from the G-buffer and the effects.
#pragma once

#include "effects/engine/compute_pass.h"
#include "effects/engine/frame_parts.h"

namespace kaamos::effects {

/// The number of samples that each sum holds; 0: the effect was not rendered, everything counts as
/// open (ambient occlusion) or there is no sun.
struct CompositeConstants {
  std::uint32_t ao_samples = 0;   ///< per pixel, of FrameParts::ambient
  std::uint32_t sun_samples = 0;  ///< per pixel, of FrameParts::sun_visibility
};

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> composite_library();

/// The frame's radiance from all effects.
class ComposePass {
 public:
  /// Makes the pass for these pictures, which must outlive it.
  /// @errors KA0537 a library without the pass; those of Frame::create_pass_views and of
  /// rtapi::Device::CreateComputePipelineState.
  static rtapi::Result<ComposePass> create(const rtapi::Device& device, const Frame& frame,
                                           const rtapi::ShaderLibrary& library,
                                           const FrameParts& parts);
  /// Records the pass, behind those that wrote the parts: it writes kRadiance.
  void dispatch(rtapi::CommandList& list, const Frame& frame) const;
  /// Bytes of the parts.
  std::uint64_t bytes() const { return views_.bytes(); }

 private:
  ComputePass pass_;
  PassViews views_;
  std::uint32_t has_ = 0;
};

/// The frame's radiance from the G-buffer, ambient occlusion and the sun's shadow alone, by sums of
/// samples.
class CompositePass {
 public:
  /// Makes the pass for FrameParts::ambient and sun_visibility, here sums of R32_FLOAT, which must
  /// outlive it.
  /// @errors KA0537 a library without it; those of Frame::create_pass_views and of
  /// rtapi::Device::CreateComputePipelineState.
  static rtapi::Result<CompositePass> create(const rtapi::Device& device, const Frame& frame,
                                             const rtapi::ShaderLibrary& library,
                                             const FrameParts& sums);
  /// Records the pass, behind those that wrote the sums: it writes kRadiance.
  void dispatch(rtapi::CommandList& list, const Frame& frame,
                const CompositeConstants& constants) const;

 private:
  ComputePass pass_;
  PassViews views_;
};

}  // namespace kaamos::effects
