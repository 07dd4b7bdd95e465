// SPDX-License-Identifier: MIT
// Blobs of cached pipelines and of pipeline libraries. They name pipelines by what these were made
// from; compiled code lies in the cache of native code, where pipelines find it by their shaders.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <directx/d3d12.h>

#include <rtapi/rtapi.h>

#include "d3d12/com/report.h"
#include "d3d12/objects/pipeline_identity.h"

namespace kaamos::d3d12 {

/// The blob of one pipeline. [D3D12: ID3D12PipelineState::GetCachedBlob]
std::vector<std::byte> write_cached_pipeline(const rtapi::Device& device, const Identity& identity);

/// Returns S_OK if `cached` is the blob of a pipeline with this identity, or if there is none.
/// [D3D12: D3D12_CACHED_PIPELINE_STATE]
/// @errors E_INVALIDARG (KA4026) it is damaged, or another pipeline's;
///     D3D12_ERROR_DRIVER_VERSION_MISMATCH (KA4026) another version of Kaamos wrote it;
///     D3D12_ERROR_ADAPTER_NOT_FOUND (KA4026) it is of another backend.
HRESULT check_cached_pipeline(const rtapi::Device& device,
                              const D3D12_CACHED_PIPELINE_STATE& cached, const Identity& identity,
                              Reporter& reporter);

/// The pipelines of a library by their names, in UTF-8.
using NamedIdentities = std::map<std::string, Identity>;

/// The blob of a library. [D3D12: ID3D12PipelineLibrary::Serialize]
std::vector<std::byte> write_pipeline_library(const rtapi::Device& device,
                                              const NamedIdentities& pipelines);

/// Reads one. @errors as check_cached_pipeline's
HRESULT read_pipeline_library(const rtapi::Device& device, const void* data, size_t size,
                              NamedIdentities& pipelines, Reporter& reporter);

}  // namespace kaamos::d3d12
