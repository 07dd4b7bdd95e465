// SPDX-License-Identifier: MIT
#include "effects/composite/composite.h"

#include <shaders/composite.h>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> composite_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_composite());
}

rtapi::Result<CompositePass> CompositePass::create(const rtapi::Device& device, const Frame& frame,
                                                   const rtapi::ShaderLibrary& library) {
  rtapi::ComputePipelineStateDesc desc;
  desc.pRootSignature = frame.root_signature();
  desc.CS = library;
  desc.EntryPoint = "Composite";
  desc.Name = "composite";
  const auto pipeline = device.CreateComputePipelineState(desc);
  if (!pipeline) return pipeline.error();
  CompositePass pass;
  pass.pipeline_ = *pipeline;
  return pass;
}

void CompositePass::dispatch(rtapi::CommandList& list, const Frame& frame,
                             const CompositeConstants& constants) const {
  PassConstants pass;
  pass.first_sample = constants.ao_samples;
  pass.sample_count = constants.sun_samples;
  frame.bind(list, pass);
  list.SetPipelineState(pipeline_);
  list.Dispatch((frame.width() + 7) / 8, (frame.height() + 7) / 8, 1);
  list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
}

}  // namespace kaamos::effects
