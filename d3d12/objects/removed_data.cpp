// SPDX-License-Identifier: MIT
#include "d3d12/objects/removed_data.h"

#include <atomic>

namespace kaamos::d3d12 {

namespace {

std::atomic<bool> g_breadcrumbs{false};
std::atomic<bool> g_page_faults{false};

bool is_on(D3D12_DRED_ENABLEMENT enablement) {
  return enablement == D3D12_DRED_ENABLEMENT_FORCED_ON;
}

class Settings final : public ComObject<ID3D12DeviceRemovedExtendedDataSettingsEntries> {
 public:
  void STDMETHODCALLTYPE SetAutoBreadcrumbsEnablement(D3D12_DRED_ENABLEMENT on) override {
    g_breadcrumbs = is_on(on);
  }
  void STDMETHODCALLTYPE SetPageFaultEnablement(D3D12_DRED_ENABLEMENT on) override {
    g_page_faults = is_on(on);
  }
  void STDMETHODCALLTYPE SetWatsonDumpEnablement(D3D12_DRED_ENABLEMENT) override {}
  void STDMETHODCALLTYPE SetBreadcrumbContextEnablement(D3D12_DRED_ENABLEMENT) override {}
  void STDMETHODCALLTYPE UseMarkersOnlyAutoBreadcrumbs(BOOL) override {}
};

}  // namespace

RemovedDataSettings removed_data_settings() {
  return {g_breadcrumbs, g_page_faults};
}

bool is_removed_data_settings(REFIID riid) {
  for (const InterfaceId& known : ID3D12DeviceRemovedExtendedDataSettingsEntries::kInterfaces) {
    if (known.guid == riid) return true;
  }
  return false;
}

HRESULT get_removed_data_settings(REFIID riid, void** settings) {
  if (settings != nullptr) *settings = nullptr;
  return hand_out(new Settings, riid, settings);
}

}  // namespace kaamos::d3d12
