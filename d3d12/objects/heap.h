// SPDX-License-Identifier: MIT
// ID3D12Heap: memory that placed resources are made in.
#pragma once

#include <utility>

#include <rtapi/heap.h>

#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

/// A heap, whose bytes resources share that overlap in it. [rtapi/heap.h]
class Heap final : public DeviceChild<ID3D12HeapEntries> {
 public:
  Heap(ID3D12Device* device, rtapi::Heap heap, const D3D12_HEAP_DESC& desc)
      : DeviceChild(device), heap_(std::move(heap)), desc_(desc) {}

  const rtapi::Heap& rtapi_heap() const { return heap_; }

  D3D12_HEAP_DESC STDMETHODCALLTYPE GetDesc() override { return desc_; }
  HRESULT STDMETHODCALLTYPE GetProtectedResourceSession(REFIID, void** session) override {
    if (session != nullptr) *session = nullptr;
    return DXGI_ERROR_NOT_FOUND;
  }

 private:
  rtapi::Heap heap_;
  D3D12_HEAP_DESC desc_;
};

}  // namespace kaamos::d3d12
