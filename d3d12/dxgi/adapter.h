// SPDX-License-Identifier: MIT
// IDXGIAdapter: a backend of rtapi.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <kaamos_adapter.h>

#include "d3d12/dxgi/dxgi_object.h"

namespace kaamos::d3d12 {

/// The description of a backend that DXGI and DXCore give.
struct AdapterInfo {
  std::string backend;
  std::wstring description;
  LUID luid = {};  // as ID3D12Device::GetAdapterLuid has it
  UINT device_id = 0;
};

/// Vendor of every adapter, which is none of PCI's.
constexpr UINT kAdapterVendor = 0x4B41;

/// The backends of this build. KAAMOS_BACKEND's comes first, as for D3D12CreateDevice.
std::vector<AdapterInfo> list_adapters();

/// Bytes of the machine's memory, all of which its adapters use.
SIZE_T memory_bytes();

/// An adapter. Its flags do not say that it is software, because programs pass over those that do.
class Adapter final : public DxgiObject<IDXGIAdapterEntries, IKaamosAdapterEntries> {
 public:
  Adapter(IUnknown* factory, AdapterInfo info) : DxgiObject(factory), info_(std::move(info)) {}

  const char* STDMETHODCALLTYPE GetBackend() override { return info_.backend.c_str(); }

  HRESULT STDMETHODCALLTYPE EnumOutputs(UINT index, IDXGIOutput** output) override;
  HRESULT STDMETHODCALLTYPE GetDesc(DXGI_ADAPTER_DESC* desc) override;
  HRESULT STDMETHODCALLTYPE GetDesc1(DXGI_ADAPTER_DESC1* desc) override;
  HRESULT STDMETHODCALLTYPE GetDesc2(DXGI_ADAPTER_DESC2* desc) override;
  HRESULT STDMETHODCALLTYPE GetDesc3(DXGI_ADAPTER_DESC3* desc) override;
  HRESULT STDMETHODCALLTYPE CheckInterfaceSupport(REFGUID guid, LARGE_INTEGER* version) override;
  HRESULT STDMETHODCALLTYPE QueryVideoMemoryInfo(UINT node, DXGI_MEMORY_SEGMENT_GROUP group,
                                                 DXGI_QUERY_VIDEO_MEMORY_INFO* info) override;
  /// The budget never changes, so the event is never set.
  HRESULT STDMETHODCALLTYPE
  RegisterVideoMemoryBudgetChangeNotificationEvent(HANDLE event, DWORD* cookie) override;
  void STDMETHODCALLTYPE UnregisterVideoMemoryBudgetChangeNotification(DWORD) override {}

 private:
  template <class Desc>
  HRESULT describe(Desc* desc);

  AdapterInfo info_;
};

}  // namespace kaamos::d3d12
