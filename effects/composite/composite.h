// SPDX-License-Identifier: MIT
// The frame's radiance from the G-buffer and the effects, by a compute shader.
#pragma once

#include "effects/frame/compute_pass.h"

namespace kaamos::effects {

/// How many samples the sums hold; 0: the effect was not rendered, everything counts as open
/// (ambient occlusion) or there is no sun.
struct CompositeConstants {
  std::uint32_t ao_samples = 0;
  std::uint32_t sun_samples = 0;
};

rtapi::Result<rtapi::ShaderLibrary> composite_library();

class CompositePass {
 public:
  static rtapi::Result<CompositePass> create(const rtapi::Device& device, const Frame& frame,
                                             const rtapi::ShaderLibrary& library);
  void dispatch(rtapi::CommandList& list, const Frame& frame,
                const CompositeConstants& constants) const;

 private:
  ComputePass pass_;
};

}  // namespace kaamos::effects
