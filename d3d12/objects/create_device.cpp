// SPDX-License-Identifier: MIT
// D3D12CreateDevice, and the other functions that hand out the first object.
#include <cstdlib>

#include <kaamos_adapter.h>
#include <rtapi/error_ids.h>

#include "d3d12/objects/debug.h"
#include "d3d12/objects/device.h"

namespace kaamos::d3d12 {

namespace {

// The backend of an adapter; without one, KAAMOS_BACKEND's, else the first.
std::string backend_of(IUnknown* adapter) {
  Microsoft::WRL::ComPtr<IKaamosAdapter> ours;
  if (adapter != nullptr &&
      SUCCEEDED(adapter->QueryInterface(__uuidof(IKaamosAdapter),
                                        reinterpret_cast<void**>(ours.GetAddressOf())))) {
    return ours->GetBackend();
  }
  const char* chosen = std::getenv("KAAMOS_BACKEND");
  return chosen != nullptr ? chosen : "";
}

// The level that KAAMOS_RAYTRACING_TIER and KAAMOS_SHADER_MODEL ask for, as programs of others
// cannot; without them, that of DeviceDesc.
rtapi::Status read_level(rtapi::DeviceDesc& desc) {
  if (const char* text = std::getenv("KAAMOS_RAYTRACING_TIER")) {
    const auto tier = rtapi::ParseRaytracingTier(text);
    if (!tier) return tier.error();
    desc.Tier = *tier;
  }
  if (const char* text = std::getenv("KAAMOS_SHADER_MODEL")) {
    const auto model = rtapi::ParseShaderModel(text);
    if (!model) return model.error();
    desc.ShaderModel = *model;
    const bool any_tier = std::getenv("KAAMOS_RAYTRACING_TIER") == nullptr;
    if (any_tier && *model < rtapi::ShaderModel::k6_9) desc.Tier = rtapi::RaytracingTier::kTier1_1;
  }
  return {};
}

// The number of a backend in the list of devices, which DXGI's adapters have too.
LUID luid_of(const std::string& backend) {
  const auto devices = rtapi::EnumerateDevices();
  for (size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].Backend == backend) return {static_cast<DWORD>(i + 1), 0};
  }
  return {0, 0};
}

D3D12_MESSAGE_SEVERITY severity_of(rtapi::MessageSeverity severity) {
  switch (severity) {
    case rtapi::MessageSeverity::kInfo:
      return D3D12_MESSAGE_SEVERITY_INFO;
    case rtapi::MessageSeverity::kWarning:
      return D3D12_MESSAGE_SEVERITY_WARNING;
    case rtapi::MessageSeverity::kError:
      break;
  }
  return D3D12_MESSAGE_SEVERITY_ERROR;
}

// rtapi's warnings that checked shaders and linked ones are interpreted.
bool is_interpreted(rtapi::ErrorId id) {
  return id == rtapi::error_ids::checked::kCodeInterpreted ||
         id == rtapi::error_ids::api::kFunctionInterpreted;
}

constexpr auto kFeatureLevel12_2 = static_cast<D3D_FEATURE_LEVEL>(0xC200);

HRESULT create_device(IUnknown* adapter, D3D_FEATURE_LEVEL level, REFIID riid, void** device) {
  if (device != nullptr) *device = nullptr;
  const bool known = level == D3D_FEATURE_LEVEL_1_0_CORE || level == D3D_FEATURE_LEVEL_11_0 ||
                     level == D3D_FEATURE_LEVEL_11_1 || level == D3D_FEATURE_LEVEL_12_0 ||
                     level == D3D_FEATURE_LEVEL_12_1 || level == kFeatureLevel12_2;
  if (!known || level == kFeatureLevel12_2) {
    char text[16];
    std::snprintf(text, sizeof(text), "0x%X", static_cast<unsigned>(level));
    const HRESULT refused = process_reporter().fail(
        ErrorId::kFeatureLevel, std::string("D3D12CreateDevice: MinimumFeatureLevel is ") + text +
                                    "; it is 0xB000 (11_0) to 0xC100 (12_1).");
    return known ? refused : E_INVALIDARG;
  }
  rtapi::DeviceDesc desc;
  std::string backend = backend_of(adapter);
  if (backend.empty()) {
    const auto devices = rtapi::EnumerateDevices();
    if (devices.empty()) {
      return process_reporter().fail(ErrorId::kAdapter,
                                     "D3D12CreateDevice: this build has no backend.");
    }
    backend = devices.front().Backend;
  }
  desc.Backend = backend;
  desc.Checked = debug_layer_enabled();
  desc.InvalidCalls = rtapi::InvalidCalls::kDropCall;
  if (const auto chosen = read_level(desc); !chosen.ok()) {
    return process_reporter().fail(chosen.error());
  }
  const auto reporter = std::make_shared<Reporter>();
  desc.OnMessage = [reporter](const rtapi::Message& message) {
    const rtapi::Error error{message.Id, rtapi::ErrorCode::kFailed, message.Text};
    if (is_interpreted(message.Id)) {
      reporter->report_interpreted(error);
    } else {
      reporter->report(severity_of(message.Severity), error);
    }
  };
  auto made = rtapi::CreateDevice(desc);
  if (!made) return process_reporter().fail(made.error());
  return hand_out(new Device(*made, reporter, desc.Checked, luid_of(backend)), riid, device);
}

}  // namespace

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the exported functions below are global

extern "C" {

HRESULT WINAPI D3D12CreateDevice(IUnknown* adapter, D3D_FEATURE_LEVEL level, REFIID riid,
                                 void** device) {
  return create_device(adapter, level, riid, device);
}

HRESULT WINAPI D3D12GetDebugInterface(REFIID riid, void** debug) {
  return get_debug_interface(riid, debug);
}

// Experimental shader models are those that are not signed, which every shader is here.
HRESULT WINAPI D3D12EnableExperimentalFeatures(UINT count, const IID* ids, void*, UINT*) {
  if (count != 0 && ids == nullptr) {
    return process_reporter().fail(ErrorId::kNullPointer,
                                   "D3D12EnableExperimentalFeatures: pIIDs.");
  }
  for (UINT i = 0; i < count; ++i) {
    if (ids[i] != D3D12ExperimentalShaderModels) {
      return process_reporter().fail(ErrorId::kAdapter,
                                     "D3D12EnableExperimentalFeatures: pIIDs[" + std::to_string(i) +
                                         "] is not D3D12ExperimentalShaderModels, the only one.");
    }
  }
  return S_OK;
}

HRESULT WINAPI D3D12GetInterface(REFCLSID class_id, REFIID riid, void** object) {
  if (class_id == CLSID_D3D12Debug) return get_debug_interface(riid, object);
  if (object != nullptr) *object = nullptr;
  // Programs probe for classes of newer systems.
  const rtapi::Error error = make_error(
      ErrorId::kAdapter, "D3D12GetInterface: the class is not CLSID_D3D12Debug, the only one.");
  process_reporter().report(D3D12_MESSAGE_SEVERITY_INFO, error);
  return to_hresult(error.code);
}

}  // extern "C"
