// SPDX-License-Identifier: MIT
#include "d3d12/objects/device.h"

namespace kaamos::d3d12 {

Device::Device(rtapi::Device device, bool debug, LUID luid)
    : device_(std::move(device)), debug_(debug), luid_(luid) {}

HRESULT Device::GetDeviceRemovedReason() {
  if (removed_) return DXGI_ERROR_DEVICE_REMOVED;
  const rtapi::Status status = device_.GetDeviceRemovedReason();
  if (status.ok()) return S_OK;
  // An endless loop or too deep a recursion is what D3D12 calls a hung device.
  return status.error().code == rtapi::ErrorCode::kOutOfMemory ? E_OUTOFMEMORY
                                                               : DXGI_ERROR_DEVICE_HUNG;
}

// Objects go on working; the reason is what programs look at.
void Device::RemoveDevice() {
  removed_ = true;
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
