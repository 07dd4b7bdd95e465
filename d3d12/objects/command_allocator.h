// SPDX-License-Identifier: MIT
// ID3D12CommandAllocator. Lists own their memory here, so that an allocator only knows which list
// records.
#pragma once

#include <atomic>

#include "d3d12/com/report.h"
#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

class CommandAllocator final : public DeviceChild<ID3D12CommandAllocatorEntries> {
 public:
  CommandAllocator(ID3D12Device* device, D3D12_COMMAND_LIST_TYPE type)
      : DeviceChild(device), type_(type) {}

  D3D12_COMMAND_LIST_TYPE type() const { return type_; }
  /// Takes the allocator for a list that records; false if another one does.
  bool begin() { return !recording_.exchange(true); }
  void end() { recording_ = false; }

  HRESULT STDMETHODCALLTYPE Reset() override {
    if (recording_) {
      fail(ErrorId::kCommandList,
           "ID3D12CommandAllocator::Reset while a list of it records. Close the list first.");
      return E_FAIL;
    }
    return S_OK;
  }

 private:
  D3D12_COMMAND_LIST_TYPE type_;
  std::atomic<bool> recording_{false};
};

}  // namespace kaamos::d3d12
