// SPDX-License-Identifier: MIT
#include "d3d12/objects/state_object.h"

#include "d3d12/objects/device.h"
#include "d3d12/objects/state_object_desc.h"

namespace kaamos::d3d12 {

void* StateObject::GetShaderIdentifier(LPCWSTR export_name) {
  const rtapi::ShaderIdentifier* id = state_object_.GetShaderIdentifier(to_utf8(export_name));
  if (id == nullptr) return nullptr;
  return const_cast<uint8_t*>(device_of(device()).shader_identifiers().keep(*id));  // D3D12's type
}

HRESULT Device::CreateStateObject(const D3D12_STATE_OBJECT_DESC* desc, REFIID riid,
                                  void** state_object) {
  if (state_object != nullptr) *state_object = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreateStateObject: pDesc.");
  const auto converted = state_object_desc(device_, *desc, reporter());
  if (!converted) return fail(converted.error());
  auto made = device_.CreateStateObject(*converted);
  if (!made) return fail(made.error());
  return hand_out(new StateObject(this, *made), riid, state_object);
}

HRESULT Device::AddToStateObject(const D3D12_STATE_OBJECT_DESC* addition, ID3D12StateObject* parent,
                                 REFIID riid, void** state_object) {
  if (state_object != nullptr) *state_object = nullptr;
  if (addition == nullptr || parent == nullptr) {
    return fail(ErrorId::kNullPointer, "AddToStateObject: pAddition or pStateObjectToGrowFrom.");
  }
  const auto converted = state_object_desc(device_, *addition, reporter());
  if (!converted) return fail(converted.error());
  auto made =
      device_.AddToStateObject(*converted, static_cast<StateObject*>(parent)->rtapi_state_object());
  if (!made) return fail(made.error());
  return hand_out(new StateObject(this, *made), riid, state_object);
}

}  // namespace kaamos::d3d12
