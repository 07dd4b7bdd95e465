// SPDX-License-Identifier: MIT
// ID3D12StateObject and its properties.
#pragma once

#include <list>
#include <mutex>

#include <rtapi/rtapi.h>

#include "d3d12/com/report.h"
#include "d3d12/com/text.h"
#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

class StateObject final
    : public DeviceChild<ID3D12StateObjectEntries, ID3D12StateObjectPropertiesEntries> {
 public:
  StateObject(ID3D12Device* device, rtapi::StateObject state_object)
      : DeviceChild(device), state_object_(std::move(state_object)) {}

  const rtapi::StateObject& rtapi_state_object() const { return state_object_; }

  // The device owns the bytes, and equal ones have the same address.
  void* STDMETHODCALLTYPE GetShaderIdentifier(LPCWSTR export_name) override;
  UINT64 STDMETHODCALLTYPE GetShaderStackSize(LPCWSTR export_name) override {
    return state_object_.GetShaderStackSize(to_utf8(export_name));
  }
  UINT64 STDMETHODCALLTYPE GetPipelineStackSize() override {
    return state_object_.GetPipelineStackSize();
  }
  void STDMETHODCALLTYPE SetPipelineStackSize(UINT64 bytes) override {
    check(state_object_.SetPipelineStackSize(bytes));
  }

 private:
  rtapi::StateObject state_object_;
};

}  // namespace kaamos::d3d12
