// SPDX-License-Identifier: MIT
// ID3D12DescriptorHeap. Handles are rtapi's own.
#pragma once

#include <rtapi/rtapi.h>

#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

class DescriptorHeap final : public DeviceChild<ID3D12DescriptorHeapEntries> {
 public:
  DescriptorHeap(ID3D12Device* device, rtapi::DescriptorHeap heap,
                 const D3D12_DESCRIPTOR_HEAP_DESC& desc)
      : DeviceChild(device), heap_(std::move(heap)), desc_(desc) {}

  const rtapi::DescriptorHeap& rtapi_heap() const { return heap_; }

  D3D12_DESCRIPTOR_HEAP_DESC STDMETHODCALLTYPE GetDesc() override { return desc_; }
  D3D12_CPU_DESCRIPTOR_HANDLE STDMETHODCALLTYPE GetCPUDescriptorHandleForHeapStart() override {
    return {heap_.GetCPUDescriptorHandleForHeapStart().ptr};
  }
  D3D12_GPU_DESCRIPTOR_HANDLE STDMETHODCALLTYPE GetGPUDescriptorHandleForHeapStart() override {
    return {heap_.GetGPUDescriptorHandleForHeapStart().ptr};
  }

 private:
  rtapi::DescriptorHeap heap_;
  D3D12_DESCRIPTOR_HEAP_DESC desc_;
};

}  // namespace kaamos::d3d12
