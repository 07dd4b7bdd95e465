// SPDX-License-Identifier: MIT
// Pipelines by name, which a program writes to disk and loads from there.
#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "d3d12/objects/cached_pipeline.h"
#include "d3d12/objects/device_child.h"
#include "d3d12/objects/pipeline_objects.h"

namespace kaamos::d3d12 {

/// A library that has read a blob knows names and identities; a pipeline is made when it is first
/// loaded, and every load of a name gives the same object. Thread-safe.
/// [D3D12: ID3D12PipelineLibrary]
class PipelineLibrary final : public DeviceChild<ID3D12PipelineLibraryEntries> {
 public:
  /// `device`: the device as ID3D12Device. `pipelines`: those of the blob.
  PipelineLibrary(ID3D12Device* device, const NamedIdentities& pipelines);

  HRESULT STDMETHODCALLTYPE StorePipeline(LPCWSTR name, ID3D12PipelineState* pipeline) override;
  HRESULT STDMETHODCALLTYPE LoadGraphicsPipeline(LPCWSTR name,
                                                 const D3D12_GRAPHICS_PIPELINE_STATE_DESC* desc,
                                                 REFIID riid, void** pipeline) override;
  HRESULT STDMETHODCALLTYPE LoadComputePipeline(LPCWSTR name,
                                                const D3D12_COMPUTE_PIPELINE_STATE_DESC* desc,
                                                REFIID riid, void** pipeline) override;
  HRESULT STDMETHODCALLTYPE LoadPipeline(LPCWSTR name, const D3D12_PIPELINE_STATE_STREAM_DESC* desc,
                                         REFIID riid, void** pipeline) override;
  SIZE_T STDMETHODCALLTYPE GetSerializedSize() override;
  HRESULT STDMETHODCALLTYPE Serialize(void* data, SIZE_T size) override;

 private:
  struct Entry {
    Identity identity;
    Held<PipelineState> pipeline;  // null until it is loaded
  };

  // `make` makes the pipeline that the caller described.
  HRESULT load(LPCWSTR name, const Identity& identity, REFIID riid, void** pipeline,
               const std::function<HRESULT(ID3D12PipelineState**)>& make);
  std::vector<std::byte> serialized();

  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

}  // namespace kaamos::d3d12
