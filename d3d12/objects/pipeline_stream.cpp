// SPDX-License-Identifier: MIT
#include "d3d12/objects/pipeline_stream.h"

#include <windows.h>

#include <string>

#include <directx/d3dx12.h>

#include "d3d12/com/errors.h"

namespace kaamos::d3d12 {

// Microsoft's own helper parses the stream.
rtapi::Result<ParsedPipeline> parse_pipeline_stream(const D3D12_PIPELINE_STATE_STREAM_DESC& stream,
                                                    const char* call) {
  CD3DX12_PIPELINE_STATE_STREAM3_PARSE_HELPER parsed;
  if (FAILED(D3DX12ParsePipelineStream(stream, &parsed))) {
    return make_error(ErrorId::kPipeline, std::string(call) + ": the stream of " +
                                              std::to_string(stream.SizeInBytes) +
                                              " bytes is damaged, or names a subobject twice.");
  }
  const D3D12_SHADER_BYTECODE& mesh =
      static_cast<const D3D12_SHADER_BYTECODE&>(parsed.PipelineStream.MS);
  if (mesh.BytecodeLength != 0) {
    return make_error(ErrorId::kPipeline,
                      std::string(call) + ": MS: there are no mesh shaders here.");
  }
  ParsedPipeline out;
  const D3D12_COMPUTE_PIPELINE_STATE_DESC compute = parsed.PipelineStream.ComputeDescV0();
  if (compute.CS.BytecodeLength != 0) {
    out.compute = compute;
  } else {
    out.graphics = parsed.PipelineStream.GraphicsDescV0();
    out.depth_stencil =
        static_cast<const CD3DX12_DEPTH_STENCIL_DESC2&>(parsed.PipelineStream.DepthStencilState);
  }
  return out;
}

}  // namespace kaamos::d3d12
