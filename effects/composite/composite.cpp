// SPDX-License-Identifier: MIT
#include "effects/composite/composite.h"

#include <shaders/composite.h>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> composite_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_composite());
}

rtapi::Result<CompositePass> CompositePass::create(const rtapi::Device& device, const Frame& frame,
                                                   const rtapi::ShaderLibrary& library) {
  const auto created = ComputePass::create(device, frame, library, "Composite");
  if (!created) return created.error();
  CompositePass pass;
  pass.pass_ = *created;
  return pass;
}

void CompositePass::dispatch(rtapi::CommandList& list, const Frame& frame,
                             const CompositeConstants& constants) const {
  PassConstants pass;
  pass.first_sample = constants.ao_samples;
  pass.sample_count = constants.sun_samples;
  pass_.dispatch(list, frame, pass, {}, frame.width(), frame.height());
}

}  // namespace kaamos::effects
