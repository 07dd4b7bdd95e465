// SPDX-License-Identifier: MIT
#include "d3d12/objects/debug.h"

#include <atomic>
#include <cstdlib>
#include <string_view>

#include "d3d12/com/object.h"
#include "d3d12/objects/removed_data.h"

namespace kaamos::d3d12 {

namespace {

std::atomic<bool> enabled{false};

// Checked mode has all that the layer and GPU-based validation look for, so that their switches and
// flags change nothing.
class Debug final : public ComObject<ID3D12DebugEntries, ID3D12Debug1Entries, ID3D12Debug2Entries> {
 public:
  void STDMETHODCALLTYPE EnableDebugLayer() override { enabled = true; }
  void STDMETHODCALLTYPE DisableDebugLayer() override { enabled = false; }
  void STDMETHODCALLTYPE SetEnableGPUBasedValidation(BOOL) override {}
  void STDMETHODCALLTYPE SetEnableSynchronizedCommandQueueValidation(BOOL) override {}
  void STDMETHODCALLTYPE SetGPUBasedValidationFlags(D3D12_GPU_BASED_VALIDATION_FLAGS) override {}
  void STDMETHODCALLTYPE SetEnableAutoName(BOOL) override {}
  void STDMETHODCALLTYPE SetForceLegacyBarrierValidation(BOOL) override {}
};

}  // namespace

bool debug_layer_enabled() {
  const char* setting = std::getenv("KAAMOS_D3D12_DEBUG");
  return enabled || (setting != nullptr && std::string_view(setting) == "1");
}

HRESULT get_debug_interface(REFIID riid, void** debug) {
  if (is_removed_data_settings(riid)) return get_removed_data_settings(riid, debug);
  if (debug != nullptr) *debug = nullptr;
  return hand_out(new Debug, riid, debug);
}

}  // namespace kaamos::d3d12
