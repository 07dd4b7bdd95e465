// SPDX-License-Identifier: MIT
#include "d3d12/objects/pipeline_library.h"

#include <windows.h>

#include <algorithm>

#include <directx/d3dx12.h>

#include "d3d12/com/text.h"
#include "d3d12/objects/device.h"
#include "d3d12/objects/pipeline_stream.h"

namespace kaamos::d3d12 {

using Microsoft::WRL::ComPtr;

PipelineLibrary::PipelineLibrary(ID3D12Device* device, const NamedIdentities& pipelines)
    : DeviceChild(device) {
  for (const auto& [name, identity] : pipelines) entries_[name].identity = identity;
}

HRESULT PipelineLibrary::StorePipeline(LPCWSTR name, ID3D12PipelineState* pipeline) {
  if (name == nullptr || pipeline == nullptr) {
    return fail(ErrorId::kNullPointer, "StorePipeline: pName or pPipeline.");
  }
  const std::lock_guard lock(mutex_);
  auto* stored = static_cast<PipelineState*>(pipeline);
  const auto [at, added] =
      entries_.try_emplace(to_utf8(name), Entry{stored->identity(), Held<PipelineState>(stored)});
  if (!added) {
    return fail(ErrorId::kCachedPipeline,
                "StorePipeline: the library has a pipeline \"" + at->first + "\" already.");
  }
  return S_OK;
}

HRESULT PipelineLibrary::load(LPCWSTR name, const Identity& identity, REFIID riid, void** pipeline,
                              const std::function<HRESULT(ID3D12PipelineState**)>& make) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(to_utf8(name));
  if (found == entries_.end()) {
    // No error: programs ask first, and make and store what is not there.
    const rtapi::Error error = make_error(ErrorId::kCachedPipeline,
                                          "the library has no pipeline \"" + to_utf8(name) + "\".");
    reporter().report(D3D12_MESSAGE_SEVERITY_WARNING, error);
    return to_hresult(error.code);
  }
  Entry& entry = found->second;
  if (entry.identity != identity) {
    return fail(ErrorId::kCachedPipeline,
                "the pipeline \"" + found->first +
                    "\" of the library has other shaders, another root signature or other states "
                    "than the description.");
  }
  ComPtr<ID3D12PipelineState> made;
  if (!entry.pipeline) {
    const HRESULT result = make(made.GetAddressOf());
    if (FAILED(result)) return result;
    entry.pipeline = Held<PipelineState>(static_cast<PipelineState*>(made.Get()));
  }
  if (pipeline == nullptr) return S_FALSE;
  return entry.pipeline->QueryInterface(riid, pipeline);
}

HRESULT PipelineLibrary::LoadGraphicsPipeline(LPCWSTR name,
                                              const D3D12_GRAPHICS_PIPELINE_STATE_DESC* desc,
                                              REFIID riid, void** pipeline) {
  if (pipeline != nullptr) *pipeline = nullptr;
  if (name == nullptr || desc == nullptr) {
    return fail(ErrorId::kNullPointer, "LoadGraphicsPipeline: pName or pDesc.");
  }
  const CD3DX12_DEPTH_STENCIL_DESC2 depth_stencil(desc->DepthStencilState);
  const Identity identity = pipeline_identity(*desc, depth_stencil);
  return load(name, identity, riid, pipeline, [&](ID3D12PipelineState** made) {
    return device()->CreateGraphicsPipelineState(desc, IID_ID3D12PipelineState,
                                                 reinterpret_cast<void**>(made));
  });
}

HRESULT PipelineLibrary::LoadComputePipeline(LPCWSTR name,
                                             const D3D12_COMPUTE_PIPELINE_STATE_DESC* desc,
                                             REFIID riid, void** pipeline) {
  if (pipeline != nullptr) *pipeline = nullptr;
  if (name == nullptr || desc == nullptr) {
    return fail(ErrorId::kNullPointer, "LoadComputePipeline: pName or pDesc.");
  }
  return load(name, pipeline_identity(*desc), riid, pipeline, [&](ID3D12PipelineState** made) {
    return device()->CreateComputePipelineState(desc, IID_ID3D12PipelineState,
                                                reinterpret_cast<void**>(made));
  });
}

HRESULT PipelineLibrary::LoadPipeline(LPCWSTR name, const D3D12_PIPELINE_STATE_STREAM_DESC* desc,
                                      REFIID riid, void** pipeline) {
  if (pipeline != nullptr) *pipeline = nullptr;
  if (name == nullptr || desc == nullptr) {
    return fail(ErrorId::kNullPointer, "LoadPipeline: pName or pDesc.");
  }
  const auto parsed = parse_pipeline_stream(*desc, "LoadPipeline");
  if (!parsed) return fail(parsed.error());
  const Identity identity = parsed->compute
                                ? pipeline_identity(*parsed->compute)
                                : pipeline_identity(*parsed->graphics, parsed->depth_stencil);
  return load(name, identity, riid, pipeline, [&](ID3D12PipelineState** made) {
    return device_of(device()).CreatePipelineState(desc, IID_ID3D12PipelineState,
                                                   reinterpret_cast<void**>(made));
  });
}

std::vector<std::byte> PipelineLibrary::serialized() {
  const std::lock_guard lock(mutex_);
  NamedIdentities pipelines;
  for (const auto& [name, entry] : entries_) pipelines[name] = entry.identity;
  return write_pipeline_library(rtapi_device(device()), pipelines);
}

SIZE_T PipelineLibrary::GetSerializedSize() {
  return serialized().size();
}

HRESULT PipelineLibrary::Serialize(void* data, SIZE_T size) {
  const std::vector<std::byte> bytes = serialized();
  if (data == nullptr || size < bytes.size()) {
    return fail(ErrorId::kCachedPipeline,
                "Serialize: pData has " + std::to_string(data != nullptr ? size : 0) +
                    " bytes; the library needs " + std::to_string(bytes.size()) +
                    ", as GetSerializedSize says.");
  }
  std::ranges::copy(bytes, static_cast<std::byte*>(data));
  return S_OK;
}

}  // namespace kaamos::d3d12
