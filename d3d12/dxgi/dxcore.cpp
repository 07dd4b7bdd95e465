// SPDX-License-Identifier: MIT
// DXCore: the same adapters as DXGI's.
#include <directx/dxcore.h>

#include <algorithm>
#include <cstring>
#include <string>

#include <wrl/client.h>

#include "d3d12/com/object.h"
#include "d3d12/com/text.h"
#include "d3d12/dxgi/adapter.h"

namespace kaamos::d3d12 {

namespace {

bool is_supported_attribute(const GUID& attribute) {
  return attribute == DXCORE_ADAPTER_ATTRIBUTE_D3D12_GRAPHICS ||
         attribute == DXCORE_ADAPTER_ATTRIBUTE_D3D12_CORE_COMPUTE;
}

class CoreAdapter final : public ComObject<IDXCoreAdapterEntries, IKaamosAdapterEntries> {
 public:
  CoreAdapter(IUnknown* factory, AdapterInfo info) : factory_(factory), info_(std::move(info)) {}

  const char* STDMETHODCALLTYPE GetBackend() override { return info_.backend.c_str(); }

  bool STDMETHODCALLTYPE IsValid() override { return true; }
  bool STDMETHODCALLTYPE IsAttributeSupported(REFGUID attribute) override {
    return is_supported_attribute(attribute);
  }
  bool STDMETHODCALLTYPE IsPropertySupported(DXCoreAdapterProperty property) override {
    return !value_of(property).empty();
  }
  HRESULT STDMETHODCALLTYPE GetPropertySize(DXCoreAdapterProperty property, size_t* size) override {
    if (size == nullptr) return E_POINTER;
    *size = value_of(property).size();
    return *size != 0 ? S_OK : DXGI_ERROR_INVALID_CALL;
  }
  HRESULT STDMETHODCALLTYPE GetProperty(DXCoreAdapterProperty property, size_t size,
                                        void* data) override {
    if (data == nullptr) return E_POINTER;
    const std::string value = value_of(property);
    if (value.empty()) return DXGI_ERROR_INVALID_CALL;
    if (size < value.size()) return E_INVALIDARG;
    std::copy(value.begin(), value.end(), static_cast<char*>(data));
    return S_OK;
  }
  bool STDMETHODCALLTYPE IsQueryStateSupported(DXCoreAdapterState) override { return false; }
  bool STDMETHODCALLTYPE IsSetStateSupported(DXCoreAdapterState) override { return false; }
  HRESULT STDMETHODCALLTYPE GetFactory(REFIID riid, void** factory) override {
    return factory_->QueryInterface(riid, factory);
  }

 private:
  template <class T>
  static std::string bytes_of(const T& value) {
    return {reinterpret_cast<const char*>(&value), sizeof(value)};
  }

  // The bytes of a property; empty: not supported.
  std::string value_of(DXCoreAdapterProperty property) const {
    switch (property) {
      case DXCoreAdapterProperty::InstanceLuid:
        return bytes_of(info_.luid);
      case DXCoreAdapterProperty::DriverVersion:
        return bytes_of(uint64_t{0});
      case DXCoreAdapterProperty::DriverDescription:
        return to_utf8(info_.description.c_str()) + '\0';
      case DXCoreAdapterProperty::HardwareID:
        return bytes_of(DXCoreHardwareID{kAdapterVendor, info_.device_id, 0, 0});
      case DXCoreAdapterProperty::HardwareIDParts:
        return bytes_of(DXCoreHardwareIDParts{kAdapterVendor, info_.device_id, 0, 0, 0});
      case DXCoreAdapterProperty::DedicatedAdapterMemory:
        return bytes_of(uint64_t{memory_bytes()});
      case DXCoreAdapterProperty::DedicatedSystemMemory:
      case DXCoreAdapterProperty::SharedSystemMemory:
        return bytes_of(uint64_t{0});
      // As for DXGI's flags: programs pass over adapters that are software.
      case DXCoreAdapterProperty::IsHardware:
      case DXCoreAdapterProperty::IsIntegrated:
        return bytes_of(true);
      case DXCoreAdapterProperty::IsDetachable:
      case DXCoreAdapterProperty::AcgCompatible:
        return bytes_of(false);
      default:
        return "";
    }
  }

  Microsoft::WRL::ComPtr<IUnknown> factory_;
  AdapterInfo info_;
};

class CoreAdapterList final : public ComObject<IDXCoreAdapterListEntries> {
 public:
  CoreAdapterList(IUnknown* factory, std::vector<AdapterInfo> list)
      : factory_(factory), list_(std::move(list)) {}

  HRESULT STDMETHODCALLTYPE GetAdapter(uint32_t index, REFIID riid, void** adapter) override {
    if (adapter == nullptr) return E_POINTER;
    *adapter = nullptr;
    if (index >= list_.size()) return E_INVALIDARG;
    return hand_out(new CoreAdapter(factory_.Get(), list_[index]), riid, adapter);
  }
  uint32_t STDMETHODCALLTYPE GetAdapterCount() override {
    return static_cast<uint32_t>(list_.size());
  }
  bool STDMETHODCALLTYPE IsStale() override { return false; }
  HRESULT STDMETHODCALLTYPE GetFactory(REFIID riid, void** factory) override {
    return factory_->QueryInterface(riid, factory);
  }
  // All are the same processor, so the order stays.
  HRESULT STDMETHODCALLTYPE Sort(uint32_t, const DXCoreAdapterPreference* preferences) override {
    return preferences != nullptr ? S_OK : E_INVALIDARG;
  }
  bool STDMETHODCALLTYPE IsAdapterPreferenceSupported(DXCoreAdapterPreference) override {
    return true;
  }

 private:
  Microsoft::WRL::ComPtr<IUnknown> factory_;
  std::vector<AdapterInfo> list_;
};

class CoreFactory final : public ComObject<IDXCoreAdapterFactoryEntries> {
 public:
  HRESULT STDMETHODCALLTYPE CreateAdapterList(uint32_t count, const GUID* attributes, REFIID riid,
                                              void** list) override {
    if (list == nullptr) return E_POINTER;
    *list = nullptr;
    if (count == 0 || attributes == nullptr) return E_INVALIDARG;
    std::vector<AdapterInfo> all = list_adapters();
    if (!std::all_of(attributes, attributes + count, is_supported_attribute)) all.clear();
    return hand_out(new CoreAdapterList(this, std::move(all)), riid, list);
  }
  HRESULT STDMETHODCALLTYPE GetAdapterByLuid(const LUID& luid, REFIID riid,
                                             void** adapter) override {
    if (adapter == nullptr) return E_POINTER;
    *adapter = nullptr;
    for (const AdapterInfo& info : list_adapters()) {
      if (info.luid.LowPart == luid.LowPart && info.luid.HighPart == luid.HighPart) {
        return hand_out(new CoreAdapter(this, info), riid, adapter);
      }
    }
    return E_INVALIDARG;
  }
  bool STDMETHODCALLTYPE IsNotificationTypeSupported(DXCoreNotificationType) override {
    return false;
  }
};

}  // namespace

}  // namespace kaamos::d3d12

extern "C" HRESULT DXCoreCreateAdapterFactory(REFIID riid, void** factory) {
  if (factory == nullptr) return E_POINTER;
  *factory = nullptr;
  return kaamos::d3d12::hand_out(new kaamos::d3d12::CoreFactory, riid, factory);
}
