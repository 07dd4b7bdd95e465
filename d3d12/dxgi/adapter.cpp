// SPDX-License-Identifier: MIT
#include "d3d12/dxgi/adapter.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <rtapi/rtapi.h>

#include "d3d12/com/text.h"
#include "d3d12/dxgi/output.h"

namespace kaamos::d3d12 {

namespace {

// Returns the bytes of memory that the process occupies: the resident pages in /proc/self/statm.
UINT64 used_bytes() {
  std::ifstream in("/proc/self/statm");
  UINT64 virtual_pages = 0, resident_pages = 0;
  in >> virtual_pages >> resident_pages;
  return resident_pages * static_cast<UINT64>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

std::vector<AdapterInfo> list_adapters() {
  std::vector<AdapterInfo> out;
  for (const rtapi::DeviceInfo& device : rtapi::EnumerateDevices()) {
    const auto number = static_cast<DWORD>(out.size() + 1);
    out.push_back({device.Backend, to_wide(device.Name), {number, 0}, number});
  }
  const char* chosen = std::getenv("KAAMOS_BACKEND");
  if (chosen != nullptr) {
    std::stable_partition(out.begin(), out.end(),
                          [&](const AdapterInfo& info) { return info.backend == chosen; });
  }
  return out;
}

SIZE_T memory_bytes() {
  return static_cast<SIZE_T>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<SIZE_T>(::sysconf(_SC_PAGESIZE));
}

// The members that all versions of the desc have.
template <class Desc>
HRESULT Adapter::describe(Desc* desc) {
  if (desc == nullptr) return E_INVALIDARG;
  *desc = {};
  info_.description.copy(desc->Description, std::size(desc->Description) - 1);
  desc->VendorId = kAdapterVendor;
  desc->DeviceId = info_.device_id;
  desc->DedicatedVideoMemory = memory_bytes();
  desc->AdapterLuid = info_.luid;
  return S_OK;
}

HRESULT Adapter::GetDesc(DXGI_ADAPTER_DESC* desc) {
  return describe(desc);
}
HRESULT Adapter::GetDesc1(DXGI_ADAPTER_DESC1* desc) {
  return describe(desc);
}
HRESULT Adapter::GetDesc2(DXGI_ADAPTER_DESC2* desc) {
  return describe(desc);
}
HRESULT Adapter::GetDesc3(DXGI_ADAPTER_DESC3* desc) {
  return describe(desc);
}

HRESULT Adapter::EnumOutputs(UINT index, IDXGIOutput** output) {
  if (output == nullptr) return E_POINTER;
  *output = nullptr;
  if (index > 0) return DXGI_ERROR_NOT_FOUND;
  *output = new Output(static_cast<IDXGIAdapter*>(this));
  return S_OK;
}

// D3D10's devices, for which the call was made, are not here.
HRESULT Adapter::CheckInterfaceSupport(REFGUID, LARGE_INTEGER* version) {
  if (version != nullptr) version->QuadPart = 0;
  return DXGI_ERROR_UNSUPPORTED;
}

HRESULT Adapter::QueryVideoMemoryInfo(UINT node, DXGI_MEMORY_SEGMENT_GROUP group,
                                      DXGI_QUERY_VIDEO_MEMORY_INFO* info) {
  if (info == nullptr || node != 0) return E_INVALIDARG;
  *info = {};
  if (group == DXGI_MEMORY_SEGMENT_GROUP_LOCAL) {
    info->Budget = memory_bytes();
    info->CurrentUsage = used_bytes();
    info->AvailableForReservation = info->Budget / 2;
  }
  return S_OK;
}

HRESULT Adapter::RegisterVideoMemoryBudgetChangeNotificationEvent(HANDLE event, DWORD* cookie) {
  if (event == nullptr || cookie == nullptr) return E_INVALIDARG;
  *cookie = 1;
  return S_OK;
}

}  // namespace kaamos::d3d12
