// SPDX-License-Identifier: MIT
// Objects that hold an rtapi handle and little else: root signatures, pipelines, query heaps,
// command signatures.
#pragma once

#include <rtapi/rtapi.h>

#include "d3d12/com/report.h"
#include "d3d12/objects/device_child.h"
#include "d3d12/objects/pipeline_identity.h"

namespace kaamos::d3d12 {

class RootSignature final : public DeviceChild<ID3D12RootSignatureEntries> {
 public:
  RootSignature(ID3D12Device* device, rtapi::RootSignature root_signature, const Identity& identity)
      : DeviceChild(device), root_signature_(std::move(root_signature)), identity_(identity) {}
  const rtapi::RootSignature& rtapi_root_signature() const { return root_signature_; }
  const Identity& identity() const { return identity_; }

 private:
  rtapi::RootSignature root_signature_;
  Identity identity_;
};

class PipelineState final : public DeviceChild<ID3D12PipelineStateEntries> {
 public:
  PipelineState(ID3D12Device* device, rtapi::PipelineState pipeline, const Identity& identity)
      : DeviceChild(device), pipeline_(std::move(pipeline)), identity_(identity) {}
  const rtapi::PipelineState& rtapi_pipeline() const { return pipeline_; }
  const Identity& identity() const { return identity_; }

  HRESULT STDMETHODCALLTYPE GetCachedBlob(ID3DBlob** blob) override;

 private:
  rtapi::PipelineState pipeline_;
  Identity identity_;
};

class QueryHeap final : public DeviceChild<ID3D12QueryHeapEntries> {
 public:
  QueryHeap(ID3D12Device* device, rtapi::QueryHeap heap)
      : DeviceChild(device), heap_(std::move(heap)) {}
  const rtapi::QueryHeap& rtapi_heap() const { return heap_; }

 private:
  rtapi::QueryHeap heap_;
};

class CommandSignature final : public DeviceChild<ID3D12CommandSignatureEntries> {
 public:
  CommandSignature(ID3D12Device* device, rtapi::CommandSignature signature)
      : DeviceChild(device), signature_(std::move(signature)) {}
  const rtapi::CommandSignature& rtapi_signature() const { return signature_; }

 private:
  rtapi::CommandSignature signature_;
};

/// Returns the object behind an interface of this library; an empty handle for null.
///@{
inline rtapi::RootSignature rtapi_root_signature(ID3D12RootSignature* object) {
  return object != nullptr ? static_cast<RootSignature*>(object)->rtapi_root_signature()
                           : rtapi::RootSignature{};
}
inline rtapi::PipelineState rtapi_pipeline(ID3D12PipelineState* object) {
  return object != nullptr ? static_cast<PipelineState*>(object)->rtapi_pipeline()
                           : rtapi::PipelineState{};
}
inline rtapi::QueryHeap rtapi_heap(ID3D12QueryHeap* object) {
  return object != nullptr ? static_cast<QueryHeap*>(object)->rtapi_heap() : rtapi::QueryHeap{};
}
inline rtapi::CommandSignature rtapi_signature(ID3D12CommandSignature* object) {
  return object != nullptr ? static_cast<CommandSignature*>(object)->rtapi_signature()
                           : rtapi::CommandSignature{};
}
///@}

}  // namespace kaamos::d3d12
