// SPDX-License-Identifier: MIT
// Streams of pipeline subobjects as the descriptions that they amount to.
#pragma once

#include <optional>

#include <directx/d3d12.h>

#include <rtapi/result.h>

namespace kaamos::d3d12 {

/// One of the two. Pointers are the stream's own.
struct ParsedPipeline {
  std::optional<D3D12_COMPUTE_PIPELINE_STATE_DESC> compute;
  std::optional<D3D12_GRAPHICS_PIPELINE_STATE_DESC> graphics;
  /// In place of graphics->DepthStencilState, which has fewer members.
  D3D12_DEPTH_STENCIL_DESC2 depth_stencil = {};
};

/// `call`: "CreatePipelineState", for messages. [D3D12: D3D12_PIPELINE_STATE_STREAM_DESC]
/// @errors KA4023 the stream is damaged, names a subobject twice, or has a mesh shader.
rtapi::Result<ParsedPipeline> parse_pipeline_stream(const D3D12_PIPELINE_STATE_STREAM_DESC& stream,
                                                    const char* call);

}  // namespace kaamos::d3d12
