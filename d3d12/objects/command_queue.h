// SPDX-License-Identifier: MIT
// ID3D12CommandQueue.
#pragma once

#include <rtapi/rtapi.h>

#include "d3d12/com/report.h"
#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

/// A queue of any type. rtapi has one kind, which can do everything.
class CommandQueue final : public DeviceChild<ID3D12CommandQueueEntries> {
 public:
  CommandQueue(ID3D12Device* device, rtapi::CommandQueue queue,
               const D3D12_COMMAND_QUEUE_DESC& desc)
      : DeviceChild(device), queue_(std::move(queue)), desc_(desc) {}

  rtapi::CommandQueue& rtapi_queue() { return queue_; }

  void STDMETHODCALLTYPE ExecuteCommandLists(UINT count, ID3D12CommandList* const* lists) override;
  // Events of a queue frame whole lists; messages name the events inside of a list.
  void STDMETHODCALLTYPE SetMarker(UINT, const void*, UINT) override {}
  void STDMETHODCALLTYPE BeginEvent(UINT, const void*, UINT) override {}
  void STDMETHODCALLTYPE EndEvent() override {}
  HRESULT STDMETHODCALLTYPE Signal(ID3D12Fence* fence, UINT64 value) override;
  HRESULT STDMETHODCALLTYPE Wait(ID3D12Fence* fence, UINT64 value) override;
  HRESULT STDMETHODCALLTYPE GetTimestampFrequency(UINT64* frequency) override;
  HRESULT STDMETHODCALLTYPE GetClockCalibration(UINT64* gpu, UINT64* cpu) override;
  D3D12_COMMAND_QUEUE_DESC STDMETHODCALLTYPE GetDesc() override { return desc_; }

 private:
  rtapi::CommandQueue queue_;
  D3D12_COMMAND_QUEUE_DESC desc_;
};

}  // namespace kaamos::d3d12
