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

  // Valid as long as the object, or one that grows from it: rtapi owns the bytes.
  void* STDMETHODCALLTYPE GetShaderIdentifier(LPCWSTR export_name) override {
    const rtapi::ShaderIdentifier* id = state_object_.GetShaderIdentifier(to_utf8(export_name));
    return id != nullptr ? const_cast<uint8_t*>(id->data()) : nullptr;  // NOLINT: D3D12's type
  }
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
