// SPDX-License-Identifier: MIT
// IDXGIObject: private data, and the object that made this one.
#pragma once

#include <dxgi1_6.h>

#include <wrl/client.h>

#include "d3d12/com/private_data.h"
#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

/// An object with IDXGIObject's methods. `First` derives from IDXGIObject.
template <class First, class... Rest>
class DxgiObject : public ComObject<First, Rest...> {
 public:
  /// `parent`: what GetParent returns, which stays alive as long as the object.
  explicit DxgiObject(IUnknown* parent) : parent_(parent) {}

  HRESULT STDMETHODCALLTYPE GetPrivateData(REFGUID guid, UINT* size, void* data) override {
    return private_data_.get(guid, size, data);
  }
  HRESULT STDMETHODCALLTYPE SetPrivateData(REFGUID guid, UINT size, const void* data) override {
    return private_data_.set(guid, size, data);
  }
  HRESULT STDMETHODCALLTYPE SetPrivateDataInterface(REFGUID guid, const IUnknown* data) override {
    return private_data_.set(guid, data);
  }
  HRESULT STDMETHODCALLTYPE GetParent(REFIID riid, void** parent) override {
    if (parent == nullptr) return E_POINTER;
    *parent = nullptr;
    return parent_ != nullptr ? parent_->QueryInterface(riid, parent) : E_NOINTERFACE;
  }

 protected:
  IUnknown* parent() const { return parent_.Get(); }

 private:
  Microsoft::WRL::ComPtr<IUnknown> parent_;
  PrivateData private_data_;
};

}  // namespace kaamos::d3d12
