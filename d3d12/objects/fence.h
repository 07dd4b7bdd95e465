// SPDX-License-Identifier: MIT
// ID3D12Fence, and events that wait for it.
#pragma once

#include <rtapi/rtapi.h>

#include "d3d12/com/report.h"
#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

class Fence final : public DeviceChild<ID3D12FenceEntries> {
 public:
  Fence(ID3D12Device* device, rtapi::Fence fence, D3D12_FENCE_FLAGS flags)
      : DeviceChild(device), fence_(std::move(fence)), flags_(flags) {}

  const rtapi::Fence& rtapi_fence() const { return fence_; }

  UINT64 STDMETHODCALLTYPE GetCompletedValue() override { return fence_.GetCompletedValue(); }
  HRESULT STDMETHODCALLTYPE SetEventOnCompletion(UINT64 value, HANDLE event) override;
  HRESULT STDMETHODCALLTYPE Signal(UINT64 value) override { return check(fence_.Signal(value)); }
  D3D12_FENCE_FLAGS STDMETHODCALLTYPE GetCreationFlags() override { return flags_; }

 private:
  rtapi::Fence fence_;
  D3D12_FENCE_FLAGS flags_;
};

}  // namespace kaamos::d3d12
