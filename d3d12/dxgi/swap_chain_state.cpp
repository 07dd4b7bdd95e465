// SPDX-License-Identifier: MIT
#include <windows.h>

#include "d3d12/dxgi/output.h"
#include "d3d12/dxgi/swap_chain.h"

namespace kaamos::d3d12 {

HRESULT SwapChain::GetDevice(REFIID riid, void** device) {
  return device_->QueryInterface(riid, device);
}

HRESULT SwapChain::GetDesc(DXGI_SWAP_CHAIN_DESC* desc) {
  if (desc == nullptr) return DXGI_ERROR_INVALID_CALL;
  *desc = {};
  desc->BufferDesc.Width = desc_.Width;
  desc->BufferDesc.Height = desc_.Height;
  desc->BufferDesc.Format = desc_.Format;
  desc->SampleDesc = desc_.SampleDesc;
  desc->BufferUsage = desc_.BufferUsage;
  desc->BufferCount = desc_.BufferCount;
  desc->OutputWindow = window_;
  desc->Windowed = TRUE;
  desc->SwapEffect = desc_.SwapEffect;
  desc->Flags = desc_.Flags;
  return S_OK;
}

HRESULT SwapChain::GetDesc1(DXGI_SWAP_CHAIN_DESC1* desc) {
  if (desc == nullptr) return DXGI_ERROR_INVALID_CALL;
  *desc = desc_;
  return S_OK;
}

HRESULT SwapChain::GetFullscreenDesc(DXGI_SWAP_CHAIN_FULLSCREEN_DESC* desc) {
  if (desc == nullptr || window_ == nullptr) return DXGI_ERROR_INVALID_CALL;
  *desc = {};
  desc->Windowed = TRUE;
  return S_OK;
}

HRESULT SwapChain::GetHwnd(HWND* window) {
  if (window == nullptr || window_ == nullptr) return DXGI_ERROR_INVALID_CALL;
  *window = window_;
  return S_OK;
}

// As where another program has the display.
HRESULT SwapChain::SetFullscreenState(BOOL fullscreen, IDXGIOutput*) {
  return fullscreen != FALSE ? DXGI_ERROR_NOT_CURRENTLY_AVAILABLE : S_OK;
}

HRESULT SwapChain::GetFullscreenState(BOOL* fullscreen, IDXGIOutput** target) {
  if (fullscreen != nullptr) *fullscreen = FALSE;
  if (target != nullptr) *target = nullptr;
  return S_OK;
}

HRESULT SwapChain::GetContainingOutput(IDXGIOutput** output) {
  if (output == nullptr || window_ == nullptr) return DXGI_ERROR_INVALID_CALL;
  *output = nullptr;
  Microsoft::WRL::ComPtr<IDXGIFactory4> factory;
  HRESULT result =
      GetParent(__uuidof(IDXGIFactory4), reinterpret_cast<void**>(factory.GetAddressOf()));
  if (FAILED(result)) return result;
  Microsoft::WRL::ComPtr<IDXGIAdapter> adapter;
  result = factory->EnumAdapterByLuid(device_->GetAdapterLuid(), __uuidof(IDXGIAdapter),
                                      reinterpret_cast<void**>(adapter.GetAddressOf()));
  return FAILED(result) ? result : adapter->EnumOutputs(0, output);
}

HRESULT SwapChain::GetRestrictToOutput(IDXGIOutput** output) {
  if (output == nullptr) return DXGI_ERROR_INVALID_CALL;
  *output = nullptr;
  return S_OK;
}

// Every present is a refresh.
HRESULT SwapChain::GetFrameStatistics(DXGI_FRAME_STATISTICS* statistics) {
  if (statistics == nullptr) return DXGI_ERROR_INVALID_CALL;
  *statistics = {};
  statistics->PresentCount = statistics->PresentRefreshCount = statistics->SyncRefreshCount =
      static_cast<UINT>(presented_);
  QueryPerformanceCounter(&statistics->SyncQPCTime);
  return S_OK;
}

HRESULT SwapChain::GetLastPresentCount(UINT* count) {
  if (count == nullptr) return DXGI_ERROR_INVALID_CALL;
  *count = static_cast<UINT>(presented_);
  return S_OK;
}

HRESULT SwapChain::SetBackgroundColor(const DXGI_RGBA* color) {
  if (color == nullptr) return DXGI_ERROR_INVALID_CALL;
  background_ = *color;
  return S_OK;
}

HRESULT SwapChain::GetBackgroundColor(DXGI_RGBA* color) {
  if (color == nullptr) return DXGI_ERROR_INVALID_CALL;
  *color = background_;
  return S_OK;
}

HRESULT SwapChain::SetRotation(DXGI_MODE_ROTATION rotation) {
  return rotation == DXGI_MODE_ROTATION_IDENTITY ? S_OK : DXGI_ERROR_INVALID_CALL;
}

HRESULT SwapChain::GetRotation(DXGI_MODE_ROTATION* rotation) {
  if (rotation == nullptr) return DXGI_ERROR_INVALID_CALL;
  *rotation = DXGI_MODE_ROTATION_IDENTITY;
  return S_OK;
}

HRESULT SwapChain::SetMaximumFrameLatency(UINT latency) {
  const bool waitable = (desc_.Flags & DXGI_SWAP_CHAIN_FLAG_FRAME_LATENCY_WAITABLE_OBJECT) != 0;
  if (!waitable || latency == 0 || latency > 16) return DXGI_ERROR_INVALID_CALL;
  latency_ = latency;
  return S_OK;
}

HRESULT SwapChain::GetMaximumFrameLatency(UINT* latency) {
  const bool waitable = (desc_.Flags & DXGI_SWAP_CHAIN_FLAG_FRAME_LATENCY_WAITABLE_OBJECT) != 0;
  if (!waitable || latency == nullptr) return DXGI_ERROR_INVALID_CALL;
  *latency = latency_;
  return S_OK;
}

// An event that stays set: no frame waits for a display. The program closes its handle.
HANDLE SwapChain::GetFrameLatencyWaitableObject() {
  if ((desc_.Flags & DXGI_SWAP_CHAIN_FLAG_FRAME_LATENCY_WAITABLE_OBJECT) == 0) return nullptr;
  if (latency_event_ == nullptr) latency_event_ = CreateEventW(nullptr, TRUE, TRUE, nullptr);
  HANDLE copy = nullptr;
  DuplicateHandle(GetCurrentProcess(), latency_event_, GetCurrentProcess(), &copy, 0, FALSE,
                  DUPLICATE_SAME_ACCESS);
  return copy;
}

// The colour space that goes with each format.
HRESULT SwapChain::CheckColorSpaceSupport(DXGI_COLOR_SPACE_TYPE space, UINT* support) {
  if (support == nullptr) return DXGI_ERROR_INVALID_CALL;
  const bool linear = desc_.Format == DXGI_FORMAT_R16G16B16A16_FLOAT;
  const auto shown =
      linear ? DXGI_COLOR_SPACE_RGB_FULL_G10_NONE_P709 : DXGI_COLOR_SPACE_RGB_FULL_G22_NONE_P709;
  *support = space == shown ? DXGI_SWAP_CHAIN_COLOR_SPACE_SUPPORT_FLAG_PRESENT : 0;
  return S_OK;
}

HRESULT SwapChain::SetColorSpace1(DXGI_COLOR_SPACE_TYPE space) {
  UINT support = 0;
  CheckColorSpaceSupport(space, &support);
  return support != 0 ? S_OK : DXGI_ERROR_INVALID_CALL;
}

HRESULT SwapChain::SetHDRMetaData(DXGI_HDR_METADATA_TYPE type, UINT, void*) {
  return type == DXGI_HDR_METADATA_TYPE_NONE ? S_OK : DXGI_ERROR_UNSUPPORTED;
}

}  // namespace kaamos::d3d12
