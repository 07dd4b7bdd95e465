// SPDX-License-Identifier: MIT
#include "d3d12/objects/device.h"

#include <rtapi/error_ids.h>

namespace kaamos::d3d12 {

Device::Device(rtapi::Device device, std::shared_ptr<Reporter> reporter, bool debug, LUID luid)
    : reporter_(std::move(reporter)), device_(std::move(device)), debug_(debug), luid_(luid) {
  listen_to(reporter_);
}

Reporter& reporter_of(ID3D12Device* device) {
  return device_of(device).reporter();
}

HRESULT Device::GetDeviceRemovedReason() {
  const rtapi::Status status = device_.GetDeviceRemovedReason();
  if (status.ok()) return S_OK;
  const rtapi::ErrorId id = status.error().id;
  if (id == rtapi::error_ids::api::kListNotExecutable) return DXGI_ERROR_INVALID_CALL;
  if (id == rtapi::error_ids::backend::kOutOfMemory) return E_OUTOFMEMORY;
  if (id == rtapi::error_ids::api::kRemovedByCall ||
      id == rtapi::error_ids::backend::kVulkanDeviceLost) {
    return DXGI_ERROR_DEVICE_REMOVED;
  }
  return DXGI_ERROR_DEVICE_HUNG;  // what D3D12 calls an endless loop or too deep a recursion
}

void Device::RemoveDevice() {
  device_.RemoveDevice();
}

void Device::rename(const std::string&) {}

bool Device::offers(REFIID riid) const {
  if (debug_) return true;
  const auto hidden = [&](const auto& ids) {
    for (const InterfaceId& id : ids) {
      if (riid == id.guid) return true;
    }
    return false;
  };
  return !hidden(ID3D12InfoQueueEntries::kInterfaces) &&
         !hidden(ID3D12DebugDeviceEntries::kInterfaces);
}

}  // namespace kaamos::d3d12
