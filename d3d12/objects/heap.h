// SPDX-License-Identifier: MIT
// ID3D12Heap: memory that placed resources are made in.
#pragma once

#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

/// A heap. It reserves no memory: each placed resource has its own, so that resources that overlap
/// in the heap do not share bytes. A program that obeys D3D12's rule on aliasing (after an aliasing
/// barrier the contents are undefined until they are written) sees no difference.
class Heap final : public DeviceChild<ID3D12HeapEntries> {
 public:
  Heap(ID3D12Device* device, const D3D12_HEAP_DESC& desc) : DeviceChild(device), desc_(desc) {}

  D3D12_HEAP_DESC STDMETHODCALLTYPE GetDesc() override { return desc_; }
  HRESULT STDMETHODCALLTYPE GetProtectedResourceSession(REFIID, void** session) override {
    if (session != nullptr) *session = nullptr;
    return DXGI_ERROR_NOT_FOUND;
  }

 private:
  D3D12_HEAP_DESC desc_;
};

}  // namespace kaamos::d3d12
