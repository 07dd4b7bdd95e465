// SPDX-License-Identifier: MIT
// DRED, Device Removed Extended Data: what a removed device can tell.
#pragma once

#include <directx/d3d12.h>

#include "d3d12/com/object.h"

namespace kaamos::d3d12 {

/// What programs ask of devices that are made from then on.
struct RemovedDataSettings {
  bool breadcrumbs = false;
  bool page_faults = false;
};
RemovedDataSettings removed_data_settings();

/// Returns whether the interface is one of the object of settings.
bool is_removed_data_settings(REFIID riid);
/// The object of settings as the interface asked for.
HRESULT get_removed_data_settings(REFIID riid, void** settings);

/// The part of a device. A list runs in the call that submits it, and what removes a device is told
/// in a message with the command and the place: there are no breadcrumbs and no faulting addresses
/// beside that, and the outputs are empty.
/// [D3D12: ID3D12DeviceRemovedExtendedData]
class RemovedData : public ID3D12DeviceRemovedExtendedDataEntries {
 public:
  HRESULT STDMETHODCALLTYPE
  GetAutoBreadcrumbsOutput(D3D12_DRED_AUTO_BREADCRUMBS_OUTPUT* output) override {
    return give_removed_data(settings_.breadcrumbs, output);
  }
  HRESULT STDMETHODCALLTYPE
  GetAutoBreadcrumbsOutput1(D3D12_DRED_AUTO_BREADCRUMBS_OUTPUT1* output) override {
    return give_removed_data(settings_.breadcrumbs, output);
  }
  HRESULT STDMETHODCALLTYPE
  GetPageFaultAllocationOutput(D3D12_DRED_PAGE_FAULT_OUTPUT* output) override {
    return give_removed_data(settings_.page_faults, output);
  }
  HRESULT STDMETHODCALLTYPE
  GetPageFaultAllocationOutput1(D3D12_DRED_PAGE_FAULT_OUTPUT1* output) override {
    return give_removed_data(settings_.page_faults, output);
  }
  HRESULT STDMETHODCALLTYPE
  GetPageFaultAllocationOutput2(D3D12_DRED_PAGE_FAULT_OUTPUT2* output) override {
    return give_removed_data(settings_.page_faults, output);
  }
  D3D12_DRED_DEVICE_STATE STDMETHODCALLTYPE GetDeviceState() override {
    const HRESULT reason = removed_reason();
    return reason == S_OK                     ? D3D12_DRED_DEVICE_STATE_UNKNOWN
           : reason == DXGI_ERROR_DEVICE_HUNG ? D3D12_DRED_DEVICE_STATE_HUNG
                                              : D3D12_DRED_DEVICE_STATE_FAULT;
  }

 protected:
  virtual HRESULT removed_reason() = 0;

 private:
  template <class Output>
  HRESULT give_removed_data(bool enabled, Output* output) {
    if (output == nullptr) return E_INVALIDARG;
    *output = {};
    if (removed_reason() == S_OK) return DXGI_ERROR_NOT_CURRENTLY_AVAILABLE;
    return enabled ? S_OK : DXGI_ERROR_UNSUPPORTED;
  }

  const RemovedDataSettings settings_ = removed_data_settings();
};

}  // namespace kaamos::d3d12
