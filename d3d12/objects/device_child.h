// SPDX-License-Identifier: MIT
// ID3D12DeviceChild: an object that keeps its device alive.
#pragma once

#include <wrl/client.h>

#include "d3d12/com/private_data.h"
#include "d3d12/objects/live_objects.h"

namespace kaamos::d3d12 {

/// That of a device of this library.
Reporter& reporter_of(ID3D12Device* device);

/// The base of the objects that a device made. `First` derives from ID3D12DeviceChild.
template <class First, class... Rest>
class DeviceChild : public NamedObject<First, Rest...> {
 public:
  /// `device`: the device as ID3D12Device, which stays alive as long as the object.
  explicit DeviceChild(ID3D12Device* device) : device_(device) {
    live_objects(device).add(this, [](const void* object) {
      const auto* child = static_cast<const DeviceChild*>(object);
      return LiveObject{First::kInterfaces[0].name, child, child->name(), child->references()};
    });
  }

  HRESULT STDMETHODCALLTYPE GetDevice(REFIID riid, void** device) override {
    return device_->QueryInterface(riid, device);
  }

 protected:
  ~DeviceChild() override { live_objects(device_.Get()).remove(this); }
  ID3D12Device* device() const { return device_.Get(); }
  Reporter& reporter() const override { return reporter_of(device_.Get()); }

 private:
  Microsoft::WRL::ComPtr<ID3D12Device> device_;
};

}  // namespace kaamos::d3d12
