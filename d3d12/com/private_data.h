// SPDX-License-Identifier: MIT
// ID3D12Object: names, and bytes and objects that a program attaches.
#pragma once

#include <cstddef>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <wrl/client.h>

#include "d3d12/com/destruction_notifier.h"
#include "d3d12/com/object.h"
#include "d3d12/com/text.h"

namespace kaamos::d3d12 {

/// The data that SetPrivateData and SetPrivateDataInterface have attached. Thread-safe.
class PrivateData {
 public:
  HRESULT get(REFGUID guid, UINT* size, void* data) const;
  HRESULT set(REFGUID guid, UINT size, const void* data);
  HRESULT set(REFGUID guid, const IUnknown* object);
  /// Returns the name set by SetName, or else a debug name among the data; UTF-8.
  std::string name() const;

 private:
  struct Less {
    bool operator()(const GUID& a, const GUID& b) const {
      return std::memcmp(&a, &b, sizeof(GUID)) < 0;
    }
  };
  struct Item {
    std::vector<std::byte> bytes;
    Microsoft::WRL::ComPtr<IUnknown> object;
  };
  mutable std::mutex mutex_;
  std::map<GUID, Item, Less> items_;
};

/// An object with ID3D12Object's methods, and ID3DDestructionNotifier as a part of it. `First`
/// derives from ID3D12Object.
template <class First, class... Rest>
class NamedObject : public ComObject<First, Rest...> {
 public:
  using ComObject<First, Rest...>::ComObject;

  HRESULT STDMETHODCALLTYPE QueryInterface(REFIID riid, void** object) override {
    if (object == nullptr || riid != ID3DDestructionNotifierEntries::kInterfaces[0].guid) {
      return ComObject<First, Rest...>::QueryInterface(riid, object);
    }
    this->AddRef();
    *object = static_cast<ID3DDestructionNotifier*>(&notifier_);
    return S_OK;
  }

  HRESULT STDMETHODCALLTYPE GetPrivateData(REFGUID guid, UINT* size, void* data) override {
    return private_data_.get(guid, size, data);
  }
  HRESULT STDMETHODCALLTYPE SetPrivateData(REFGUID guid, UINT size, const void* data) override {
    const HRESULT result = private_data_.set(guid, size, data);
    if (guid == WKPDID_D3DDebugObjectName || guid == WKPDID_D3DDebugObjectNameW) rename(name());
    return result;
  }
  HRESULT STDMETHODCALLTYPE SetPrivateDataInterface(REFGUID guid, const IUnknown* data) override {
    return private_data_.set(guid, data);
  }
  /// The name is private data too, under WKPDID_D3DDebugObjectNameW.
  HRESULT STDMETHODCALLTYPE SetName(LPCWSTR name) override {
    if (name == nullptr) return E_INVALIDARG;
    rename(to_utf8(name));
    const std::wstring_view text(name);
    return private_data_.set(WKPDID_D3DDebugObjectNameW,
                             static_cast<UINT>((text.size() + 1) * sizeof(wchar_t)), name);
  }

 protected:
  ~NamedObject() override { notifier_.destroyed(); }
  std::string name() const { return private_data_.name(); }
  /// Sets the name by which messages call the object from now on.
  virtual void rename(const std::string&) {}

 private:
  PrivateData private_data_;
  DestructionNotifier notifier_{static_cast<First*>(this)};
};

}  // namespace kaamos::d3d12
