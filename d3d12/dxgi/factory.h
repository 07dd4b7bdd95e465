// SPDX-License-Identifier: MIT
// IDXGIFactory: adapters and swap chains.
#pragma once

#include "d3d12/dxgi/adapter.h"

namespace kaamos::d3d12 {

/// The object that CreateDXGIFactory makes.
class Factory final : public DxgiObject<IDXGIFactoryEntries> {
 public:
  explicit Factory(UINT flags) : DxgiObject(nullptr), flags_(flags) {}

  HRESULT STDMETHODCALLTYPE EnumAdapters(UINT index, IDXGIAdapter** adapter) override;
  HRESULT STDMETHODCALLTYPE EnumAdapters1(UINT index, IDXGIAdapter1** adapter) override;
  HRESULT STDMETHODCALLTYPE EnumAdapterByLuid(LUID luid, REFIID riid, void** adapter) override;
  HRESULT STDMETHODCALLTYPE EnumAdapterByGpuPreference(UINT index, DXGI_GPU_PREFERENCE preference,
                                                       REFIID riid, void** adapter) override;
  /// The first adapter: all of them run on the processor.
  HRESULT STDMETHODCALLTYPE EnumWarpAdapter(REFIID riid, void** adapter) override;
  BOOL STDMETHODCALLTYPE IsCurrent() override { return TRUE; }
  UINT STDMETHODCALLTYPE GetCreationFlags() override { return flags_; }
  BOOL STDMETHODCALLTYPE IsWindowedStereoEnabled() override { return FALSE; }
  HRESULT STDMETHODCALLTYPE CheckFeatureSupport(DXGI_FEATURE feature, void* data,
                                                UINT size) override;

  HRESULT STDMETHODCALLTYPE MakeWindowAssociation(HWND window, UINT flags) override;
  HRESULT STDMETHODCALLTYPE GetWindowAssociation(HWND* window) override;

  HRESULT STDMETHODCALLTYPE CreateSwapChain(IUnknown* queue, DXGI_SWAP_CHAIN_DESC* desc,
                                            IDXGISwapChain** chain) override;
  HRESULT STDMETHODCALLTYPE
  CreateSwapChainForHwnd(IUnknown* queue, HWND window, const DXGI_SWAP_CHAIN_DESC1* desc,
                         const DXGI_SWAP_CHAIN_FULLSCREEN_DESC* fullscreen,
                         IDXGIOutput* restrict_to, IDXGISwapChain1** chain) override;
  /// Without a window: frames go where KAAMOS_PRESENT says, and nothing ends the program.
  HRESULT STDMETHODCALLTYPE CreateSwapChainForComposition(IUnknown* queue,
                                                          const DXGI_SWAP_CHAIN_DESC1* desc,
                                                          IDXGIOutput* restrict_to,
                                                          IDXGISwapChain1** chain) override;

 private:
  UINT flags_;
  HWND associated_ = nullptr;
};

}  // namespace kaamos::d3d12
