// SPDX-License-Identifier: MIT
#include "d3d12/dxgi/factory.h"

#include <dxgidebug.h>

#include "d3d12/dxgi/swap_chain.h"

namespace kaamos::d3d12 {

namespace {

// The adapter at an index of a list, or DXGI_ERROR_NOT_FOUND, by which programs know the end.
HRESULT hand_out_adapter(IUnknown* factory, const std::vector<AdapterInfo>& list, size_t index,
                         REFIID riid, void** adapter) {
  if (adapter == nullptr) return DXGI_ERROR_INVALID_CALL;
  *adapter = nullptr;
  if (index >= list.size()) return DXGI_ERROR_NOT_FOUND;
  return hand_out(new Adapter(factory, list[index]), riid, adapter);
}

HRESULT create_factory(UINT flags, REFIID riid, void** factory) {
  if (factory == nullptr) return E_INVALIDARG;
  *factory = nullptr;
  return hand_out(new Factory(flags), riid, factory);
}

// Windows has these interfaces where its graphics tools are installed; programs ask in vain where
// they are not.
HRESULT get_debug_interface(void** debug) {
  if (debug != nullptr) *debug = nullptr;
  return DXGI_ERROR_SDK_COMPONENT_MISSING;
}

}  // namespace

HRESULT Factory::EnumAdapters(UINT index, IDXGIAdapter** adapter) {
  return hand_out_adapter(this, list_adapters(), index, __uuidof(IDXGIAdapter),
                          reinterpret_cast<void**>(adapter));
}

HRESULT Factory::EnumAdapters1(UINT index, IDXGIAdapter1** adapter) {
  return hand_out_adapter(this, list_adapters(), index, __uuidof(IDXGIAdapter1),
                          reinterpret_cast<void**>(adapter));
}

HRESULT Factory::EnumAdapterByLuid(LUID luid, REFIID riid, void** adapter) {
  const auto list = list_adapters();
  size_t i = 0;
  while (i < list.size() && (list[i].luid.LowPart != luid.LowPart || luid.HighPart != 0)) ++i;
  return hand_out_adapter(this, list, i, riid, adapter);
}

HRESULT Factory::EnumAdapterByGpuPreference(UINT index, DXGI_GPU_PREFERENCE, REFIID riid,
                                            void** adapter) {
  return hand_out_adapter(this, list_adapters(), index, riid, adapter);
}

HRESULT Factory::EnumWarpAdapter(REFIID riid, void** adapter) {
  return hand_out_adapter(this, list_adapters(), 0, riid, adapter);
}

HRESULT Factory::CheckFeatureSupport(DXGI_FEATURE feature, void* data, UINT size) {
  if (feature != DXGI_FEATURE_PRESENT_ALLOW_TEARING || data == nullptr || size != sizeof(BOOL)) {
    return E_INVALIDARG;
  }
  const BOOL allowed = TRUE;
  std::memcpy(data, &allowed, sizeof(allowed));
  return S_OK;
}

HRESULT Factory::MakeWindowAssociation(HWND window, UINT flags) {
  if ((flags & ~static_cast<UINT>(DXGI_MWA_VALID)) != 0) return DXGI_ERROR_INVALID_CALL;
  associated_ = window;
  return S_OK;
}

HRESULT Factory::GetWindowAssociation(HWND* window) {
  if (window == nullptr) return DXGI_ERROR_INVALID_CALL;
  *window = associated_;
  return S_OK;
}

HRESULT Factory::CreateSwapChain(IUnknown* queue, DXGI_SWAP_CHAIN_DESC* desc,
                                 IDXGISwapChain** chain) {
  if (chain != nullptr) *chain = nullptr;
  if (desc == nullptr || desc->OutputWindow == nullptr) {
    return fail(ErrorId::kNullPointer, "CreateSwapChain: pDesc or its OutputWindow.");
  }
  DXGI_SWAP_CHAIN_DESC1 newer = {};
  newer.Width = desc->BufferDesc.Width;
  newer.Height = desc->BufferDesc.Height;
  newer.Format = desc->BufferDesc.Format;
  newer.SampleDesc = desc->SampleDesc;
  newer.BufferUsage = desc->BufferUsage;
  newer.BufferCount = desc->BufferCount;
  newer.Scaling = DXGI_SCALING_STRETCH;
  newer.SwapEffect = desc->SwapEffect;
  newer.Flags = desc->Flags;
  return create_swap_chain(this, queue, newer, desc->OutputWindow, __uuidof(IDXGISwapChain),
                           reinterpret_cast<void**>(chain));
}

HRESULT Factory::CreateSwapChainForHwnd(IUnknown* queue, HWND window,
                                        const DXGI_SWAP_CHAIN_DESC1* desc,
                                        const DXGI_SWAP_CHAIN_FULLSCREEN_DESC* fullscreen,
                                        IDXGIOutput*, IDXGISwapChain1** chain) {
  if (chain != nullptr) *chain = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreateSwapChainForHwnd: pDesc.");
  if (window == nullptr) {
    return fail(ErrorId::kSwapChain, "CreateSwapChainForHwnd: hWnd is null.");
  }
  if (fullscreen != nullptr && fullscreen->Windowed == FALSE) {
    return fail(ErrorId::kSwapChain,
                "CreateSwapChainForHwnd: pFullscreenDesc->Windowed is FALSE; there is no display "
                "to take over.");
  }
  return create_swap_chain(this, queue, *desc, window, __uuidof(IDXGISwapChain1),
                           reinterpret_cast<void**>(chain));
}

HRESULT Factory::CreateSwapChainForComposition(IUnknown* queue, const DXGI_SWAP_CHAIN_DESC1* desc,
                                               IDXGIOutput*, IDXGISwapChain1** chain) {
  if (chain != nullptr) *chain = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreateSwapChainForComposition: pDesc.");
  return create_swap_chain(this, queue, *desc, nullptr, __uuidof(IDXGISwapChain1),
                           reinterpret_cast<void**>(chain));
}

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the exported functions below are global

extern "C" {

HRESULT CreateDXGIFactory(REFIID riid, void** factory) {
  return create_factory(0, riid, factory);
}
HRESULT CreateDXGIFactory1(REFIID riid, void** factory) {
  return create_factory(0, riid, factory);
}
HRESULT CreateDXGIFactory2(UINT flags, REFIID riid, void** factory) {
  return create_factory(flags, riid, factory);
}
HRESULT DXGIGetDebugInterface(REFIID, void** debug) {
  return get_debug_interface(debug);
}
HRESULT DXGIGetDebugInterface1(UINT, REFIID, void** debug) {
  return get_debug_interface(debug);
}
// No adapter is ever removed.
HRESULT DXGIDeclareAdapterRemovalSupport() {
  return S_OK;
}

}  // extern "C"
