// SPDX-License-Identifier: MIT
#include "effects/engine/compute_pass.h"

namespace kaamos::effects {

rtapi::Result<ComputePass> ComputePass::create(const rtapi::Device& device, const Frame& frame,
                                               const rtapi::ShaderLibrary& library,
                                               std::string entry_point) {
  rtapi::ComputePipelineStateDesc desc;
  desc.pRootSignature = frame.root_signature();
  desc.CS = library;
  desc.EntryPoint = entry_point;
  desc.Name = std::move(entry_point);
  const auto pipeline = device.CreateComputePipelineState(desc);
  if (!pipeline) return pipeline.error();
  ComputePass pass;
  pass.pipeline_ = *pipeline;
  return pass;
}

void ComputePass::dispatch(rtapi::CommandList& list, const Frame& frame,
                           const PassConstants& constants, const PassArguments& arguments,
                           std::uint32_t width, std::uint32_t height) const {
  dispatch_groups(list, frame, constants, arguments, (width + 7) / 8, (height + 7) / 8);
}

void ComputePass::dispatch_groups(rtapi::CommandList& list, const Frame& frame,
                                  const PassConstants& constants, const PassArguments& arguments,
                                  std::uint32_t groups_x, std::uint32_t groups_y) const {
  frame.bind(list, constants, arguments);
  list.SetPipelineState(pipeline_);
  list.Dispatch(groups_x, groups_y, 1);
  list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
}

void ComputePass::dispatch_indirect(rtapi::CommandList& list, const Frame& frame,
                                    const PassConstants& constants,
                                    const PassArguments& pass_arguments,
                                    const rtapi::CommandSignature& signature,
                                    const rtapi::Buffer& arguments) const {
  frame.bind(list, constants, pass_arguments);
  list.SetPipelineState(pipeline_);
  list.ExecuteIndirect(signature, 1, arguments, 0);
  list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
}

}  // namespace kaamos::effects
