// SPDX-License-Identifier: MIT
/// @file
/// A compute pipeline over a frame, one thread per pixel of a picture.
#pragma once

#include <rtapi/rtapi.h>

#include <string>

#include "effects/engine/frame.h"
#include "effects/engine/pass_views.h"

namespace kaamos::effects {

/// One compute pipeline over a frame, with the frame's root signature.
class ComputePass {
 public:
  /// Makes a pass of a compute shader with [numthreads(8, 8, 1)]. It keeps nothing of the frame but
  /// its root signature.
  /// @errors KA0537 no such shader in the library; those of
  /// rtapi::Device::CreateComputePipelineState.
  static rtapi::Result<ComputePass> create(const rtapi::Device& device, const Frame& frame,
                                           const rtapi::ShaderLibrary& library,
                                           std::string entry_point);
  /// Records a dispatch that covers width x height threads, and the barrier behind it.
  void dispatch(rtapi::CommandList& list, const Frame& frame, const PassConstants& constants,
                const PassArguments& arguments, std::uint32_t width, std::uint32_t height) const;

  /// The same for shaders with thread groups of another size.
  void dispatch_groups(rtapi::CommandList& list, const Frame& frame, const PassConstants& constants,
                       const PassArguments& arguments, std::uint32_t groups_x,
                       std::uint32_t groups_y) const;

  /// The same for as many groups as `arguments` holds at its start when the list executes: three
  /// words. `signature`: of dispatches alone. The barrier behind it is recorded too.
  void dispatch_indirect(rtapi::CommandList& list, const Frame& frame,
                         const PassConstants& constants, const PassArguments& pass_arguments,
                         const rtapi::CommandSignature& signature,
                         const rtapi::Buffer& arguments) const;

 private:
  rtapi::PipelineState pipeline_;
};

}  // namespace kaamos::effects
