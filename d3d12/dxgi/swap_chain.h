// SPDX-License-Identifier: MIT
// IDXGISwapChain: back buffers that a program draws to and presents.
#pragma once

#include <directx/d3d12.h>

#include <deque>
#include <mutex>
#include <vector>

#include <rtapi/rtapi.h>

#include "d3d12/dxgi/dxgi_object.h"
#include "d3d12/dxgi/frame.h"
#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

/// A swap chain of the flip model, without a display: a presented frame goes to deliver_frame.
/// Present and what goes with it is in swap_chain.cpp, what only keeps values in
/// swap_chain_state.cpp. As in DXGI, one thread at a time may call it.
class SwapChain final : public DxgiObject<IDXGISwapChainEntries> {
 public:
  SwapChain(IUnknown* factory, ID3D12CommandQueue* queue, const DXGI_SWAP_CHAIN_DESC1& desc,
            HWND window);
  ~SwapChain() override;

  /// Makes the back buffers that `desc` describes, which is the swap chain's from then on. After an
  /// error everything is as it was.
  /// @errors KA4040 and those of CreateCommittedResource.
  HRESULT make_buffers(const DXGI_SWAP_CHAIN_DESC1& desc);

  Reporter& reporter() const override { return reporter_of(device_.Get()); }

  HRESULT STDMETHODCALLTYPE Present(UINT sync_interval, UINT flags) override;
  HRESULT STDMETHODCALLTYPE Present1(UINT sync_interval, UINT flags,
                                     const DXGI_PRESENT_PARAMETERS* parameters) override;
  HRESULT STDMETHODCALLTYPE GetBuffer(UINT index, REFIID riid, void** buffer) override;
  HRESULT STDMETHODCALLTYPE ResizeBuffers(UINT count, UINT width, UINT height, DXGI_FORMAT format,
                                          UINT flags) override;
  HRESULT STDMETHODCALLTYPE ResizeBuffers1(UINT count, UINT width, UINT height, DXGI_FORMAT format,
                                           UINT flags, const UINT* node_masks,
                                           IUnknown* const* queues) override;
  HRESULT STDMETHODCALLTYPE ResizeTarget(const DXGI_MODE_DESC* mode) override;
  UINT STDMETHODCALLTYPE GetCurrentBackBufferIndex() override;

  HRESULT STDMETHODCALLTYPE GetDevice(REFIID riid, void** device) override;
  HRESULT STDMETHODCALLTYPE GetDesc(DXGI_SWAP_CHAIN_DESC* desc) override;
  HRESULT STDMETHODCALLTYPE GetDesc1(DXGI_SWAP_CHAIN_DESC1* desc) override;
  HRESULT STDMETHODCALLTYPE GetFullscreenDesc(DXGI_SWAP_CHAIN_FULLSCREEN_DESC* desc) override;
  HRESULT STDMETHODCALLTYPE GetHwnd(HWND* window) override;
  HRESULT STDMETHODCALLTYPE SetFullscreenState(BOOL fullscreen, IDXGIOutput* target) override;
  HRESULT STDMETHODCALLTYPE GetFullscreenState(BOOL* fullscreen, IDXGIOutput** target) override;
  HRESULT STDMETHODCALLTYPE GetContainingOutput(IDXGIOutput** output) override;
  HRESULT STDMETHODCALLTYPE GetRestrictToOutput(IDXGIOutput** output) override;
  HRESULT STDMETHODCALLTYPE GetFrameStatistics(DXGI_FRAME_STATISTICS* statistics) override;
  HRESULT STDMETHODCALLTYPE GetLastPresentCount(UINT* count) override;
  BOOL STDMETHODCALLTYPE IsTemporaryMonoSupported() override { return FALSE; }
  HRESULT STDMETHODCALLTYPE SetBackgroundColor(const DXGI_RGBA* color) override;
  HRESULT STDMETHODCALLTYPE GetBackgroundColor(DXGI_RGBA* color) override;
  HRESULT STDMETHODCALLTYPE SetRotation(DXGI_MODE_ROTATION rotation) override;
  HRESULT STDMETHODCALLTYPE GetRotation(DXGI_MODE_ROTATION* rotation) override;
  HRESULT STDMETHODCALLTYPE SetMaximumFrameLatency(UINT latency) override;
  HRESULT STDMETHODCALLTYPE GetMaximumFrameLatency(UINT* latency) override;
  HANDLE STDMETHODCALLTYPE GetFrameLatencyWaitableObject() override;
  HRESULT STDMETHODCALLTYPE CheckColorSpaceSupport(DXGI_COLOR_SPACE_TYPE space,
                                                   UINT* support) override;
  HRESULT STDMETHODCALLTYPE SetColorSpace1(DXGI_COLOR_SPACE_TYPE space) override;
  HRESULT STDMETHODCALLTYPE SetHDRMetaData(DXGI_HDR_METADATA_TYPE type, UINT size,
                                           void* data) override;

 private:
  // A frame that was copied, or will be when its queue gets there.
  struct Copied {
    UINT64 number;
    UINT width;
    UINT height;
    DXGI_FORMAT format;
    UINT row_bytes;
    rtapi::Buffer buffer;
    UINT64 fence_value;
  };

  HRESULT refuse(const std::string& detail) const;
  HRESULT copy_frame();
  void deliver_finished();

  Microsoft::WRL::ComPtr<ID3D12CommandQueue> queue_;
  Microsoft::WRL::ComPtr<ID3D12Device> device_;
  DXGI_SWAP_CHAIN_DESC1 desc_;
  HWND window_;
  UINT chain_;  // of the process, from 1
  std::vector<Microsoft::WRL::ComPtr<ID3D12Resource>> buffers_;
  UINT64 presented_ = 0;
  UINT current_ = 0;  // the buffer that the program draws to

  rtapi::Fence fence_;
  std::deque<Copied> copied_;
  bool told_ = false;  // that frames cannot be written

  DXGI_RGBA background_ = {};
  UINT latency_ = 1;
  HANDLE latency_event_ = nullptr;
};

/// Checks a description by the rules of the flip model and makes the swap chain.
/// @errors KA4001 null; KA4040 a member, an object that is not a queue, a window that has one
/// already. They are messages of the device of `queue`, if it has one.
HRESULT create_swap_chain(IUnknown* factory, IUnknown* queue, const DXGI_SWAP_CHAIN_DESC1& desc,
                          HWND window, REFIID riid, void** chain);

}  // namespace kaamos::d3d12
