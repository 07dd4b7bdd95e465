// SPDX-License-Identifier: MIT
// What a pipeline was made from, by value: cached pipelines are found by it.
#pragma once

#include <array>
#include <cstdint>

#include <directx/d3d12.h>

namespace kaamos::d3d12 {

/// 128 bits, equal for equal descriptions wherever these lie in memory.
using Identity = std::array<uint32_t, 4>;

/// That of a serialized root signature, or of a library that declares one; with several, the name
/// of one follows the bytes of the library.
Identity root_signature_identity(const void* blob, size_t size);

/// Those of pipelines: of all members but NodeMask, CachedPSO and Flags, with the bytes of shaders
/// and root signatures. `depth_stencil` stands in place of the desc's own.
///@{
Identity pipeline_identity(const D3D12_COMPUTE_PIPELINE_STATE_DESC& desc);
Identity pipeline_identity(const D3D12_GRAPHICS_PIPELINE_STATE_DESC& desc,
                           const D3D12_DEPTH_STENCIL_DESC2& depth_stencil);
///@}

}  // namespace kaamos::d3d12
