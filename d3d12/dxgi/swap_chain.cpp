// SPDX-License-Identifier: MIT
#include "d3d12/dxgi/swap_chain.h"

#include <windows.h>

#include <atomic>
#include <set>
#include <string>

#include "d3d12/dxgi/output.h"
#include "d3d12/objects/command_queue.h"
#include "d3d12/objects/device.h"
#include "d3d12/objects/resource.h"
#include "d3d12/win32/window.h"

namespace kaamos::d3d12 {

using Microsoft::WRL::ComPtr;

namespace {

constexpr UINT kLastingFlags =
    DXGI_SWAP_CHAIN_FLAG_ALLOW_TEARING | DXGI_SWAP_CHAIN_FLAG_FRAME_LATENCY_WAITABLE_OBJECT;

// Windows with a swap chain of the flip model, of which each can have one.
struct ClaimedWindows {
  std::mutex mutex;
  std::set<HWND> windows;
};
ClaimedWindows& claimed() {
  static auto* all =
      new ClaimedWindows;  // lives on: programs release global swap chains after main
  return *all;
}

bool claim_window(HWND window) {
  std::scoped_lock lock(claimed().mutex);
  return window == nullptr || claimed().windows.insert(window).second;
}

void free_window(HWND window) {
  std::scoped_lock lock(claimed().mutex);
  claimed().windows.erase(window);
}

// Bad values of a call's arguments are DXGI_ERROR_INVALID_CALL, whichever they are.
HRESULT refuse_call(Reporter& reporter, const std::string& detail) {
  reporter.fail(ErrorId::kSwapChain, detail);
  return DXGI_ERROR_INVALID_CALL;
}

// Returns what is wrong with a description, or "". [DXGI: DXGI_SWAP_CHAIN_DESC1; DXGI_SWAP_EFFECT]
std::string find_fault(const DXGI_SWAP_CHAIN_DESC1& desc) {
  if (desc.BufferCount < 2 || desc.BufferCount > DXGI_MAX_SWAP_CHAIN_BUFFERS) {
    return "BufferCount is " + std::to_string(desc.BufferCount) + "; the flip model has 2 to 16.";
  }
  if (desc.SwapEffect != DXGI_SWAP_EFFECT_FLIP_SEQUENTIAL &&
      desc.SwapEffect != DXGI_SWAP_EFFECT_FLIP_DISCARD) {
    return "SwapEffect is " + std::to_string(desc.SwapEffect) +
           "; D3D12 takes DXGI_SWAP_EFFECT_FLIP_SEQUENTIAL (3) and _FLIP_DISCARD (4).";
  }
  if (desc.SampleDesc.Count != 1 || desc.SampleDesc.Quality != 0) {
    return "SampleDesc is {" + std::to_string(desc.SampleDesc.Count) + ", " +
           std::to_string(desc.SampleDesc.Quality) +
           "}; buffers of the flip model have {1, 0}. Resolve to them.";
  }
  if (!is_display_format(desc.Format)) {
    return "Format is " + std::to_string(desc.Format) +
           "; the flip model has R16G16B16A16_FLOAT (10), R10G10B10A2_UNORM (24), R8G8B8A8_UNORM "
           "(28) and B8G8R8A8_UNORM (87). For sRGB make an sRGB view of the buffer.";
  }
  return "";
}

// 0 is the window's.
void fill_size(DXGI_SWAP_CHAIN_DESC1& desc, HWND window) {
  const std::optional<SIZE> size = window != nullptr ? window_size(window) : std::nullopt;
  if (!size) return;
  if (desc.Width == 0) desc.Width = static_cast<UINT>(std::max<LONG>(size->cx, 1));
  if (desc.Height == 0) desc.Height = static_cast<UINT>(std::max<LONG>(size->cy, 1));
}

UINT next_chain() {
  static std::atomic<UINT> count{0};
  return ++count;
}

}  // namespace

SwapChain::SwapChain(IUnknown* factory, ID3D12CommandQueue* queue,
                     const DXGI_SWAP_CHAIN_DESC1& desc, HWND window)
    : DxgiObject(factory), queue_(queue), desc_(desc), window_(window), chain_(next_chain()) {
  queue_->GetDevice(IID_ID3D12Device, reinterpret_cast<void**>(device_.GetAddressOf()));
}

SwapChain::~SwapChain() {
  deliver_finished();
  if (latency_event_ != nullptr) CloseHandle(latency_event_);
  free_window(window_);
}

HRESULT SwapChain::refuse(const std::string& detail) const {
  return refuse_call(reporter(), detail);
}

HRESULT SwapChain::make_buffers(const DXGI_SWAP_CHAIN_DESC1& desc) {
  if (desc.Width == 0 || desc.Height == 0) {
    return refuse("a swap chain of " + std::to_string(desc.Width) + " x " +
                  std::to_string(desc.Height) +
                  " pixels; 0 stands for the window's size, and there is no window.");
  }
  D3D12_HEAP_PROPERTIES heap = {};
  heap.Type = D3D12_HEAP_TYPE_DEFAULT;
  D3D12_RESOURCE_DESC texture = {};
  texture.Dimension = D3D12_RESOURCE_DIMENSION_TEXTURE2D;
  texture.Width = desc.Width;
  texture.Height = desc.Height;
  texture.DepthOrArraySize = texture.MipLevels = 1;
  texture.Format = desc.Format;
  texture.SampleDesc.Count = 1;
  texture.Flags = D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET;
  if ((desc.BufferUsage & DXGI_USAGE_UNORDERED_ACCESS) != 0) {
    texture.Flags |= D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS;
  }
  std::vector<ComPtr<ID3D12Resource>> made;
  for (UINT i = 0; i < desc.BufferCount; ++i) {
    ComPtr<ID3D12Resource> buffer;
    const HRESULT result = device_->CreateCommittedResource(
        &heap, D3D12_HEAP_FLAG_NONE, &texture, D3D12_RESOURCE_STATE_PRESENT, nullptr,
        IID_ID3D12Resource, reinterpret_cast<void**>(buffer.GetAddressOf()));
    if (FAILED(result)) return result;
    buffer->SetName((L"back buffer " + std::to_wstring(i)).c_str());
    made.push_back(buffer);
  }
  buffers_ = std::move(made);
  desc_ = desc;
  current_ = 0;
  return S_OK;
}

HRESULT SwapChain::GetBuffer(UINT index, REFIID riid, void** buffer) {
  if (buffer == nullptr) return DXGI_ERROR_INVALID_CALL;
  *buffer = nullptr;
  if (index >= buffers_.size()) {
    return refuse("GetBuffer: Buffer is " + std::to_string(index) + "; there are " +
                  std::to_string(buffers_.size()) + ".");
  }
  return buffers_[index]->QueryInterface(riid, buffer);
}

UINT SwapChain::GetCurrentBackBufferIndex() {
  return current_;
}

HRESULT SwapChain::Present(UINT sync_interval, UINT flags) {
  return Present1(sync_interval, flags, nullptr);
}

HRESULT SwapChain::Present1(UINT sync_interval, UINT flags, const DXGI_PRESENT_PARAMETERS*) {
  if (sync_interval > 4) {
    return refuse("Present: SyncInterval is " + std::to_string(sync_interval) +
                  "; it is from 0 to 4.");
  }
  if ((flags & DXGI_PRESENT_ALLOW_TEARING) != 0 &&
      (sync_interval != 0 || (desc_.Flags & DXGI_SWAP_CHAIN_FLAG_ALLOW_TEARING) == 0)) {
    return refuse(
        "Present: DXGI_PRESENT_ALLOW_TEARING needs SyncInterval 0 and a swap chain with "
        "DXGI_SWAP_CHAIN_FLAG_ALLOW_TEARING.");
  }
  if (FAILED(device_->GetDeviceRemovedReason())) return DXGI_ERROR_DEVICE_REMOVED;
  if ((flags & DXGI_PRESENT_TEST) != 0) return S_OK;
  deliver_finished();
  if (wants_frame(presented_)) {
    if (const HRESULT result = copy_frame(); FAILED(result)) return result;
    deliver_finished();
  }
  ++presented_;
  if ((flags & DXGI_PRESENT_DO_NOT_SEQUENCE) == 0) current_ = (current_ + 1) % buffers_.size();
  if (window_ != nullptr) count_frame(window_);
  return S_OK;
}

// Copies the current back buffer on the queue, behind what the program has submitted.
HRESULT SwapChain::copy_frame() {
  const rtapi::Device& device = rtapi_device(device_.Get());
  auto& queue = static_cast<CommandQueue*>(queue_.Get())->rtapi_queue();
  const rtapi::Texture texture = rtapi_texture(buffers_[current_].Get());
  std::vector<rtapi::PlacedSubresourceFootprint> layouts;
  const auto bytes = device.GetCopyableFootprints(texture.GetDesc(), 0, 1, 0, &layouts);
  if (!bytes) return fail(bytes.error());
  const auto buffer =
      device.CreateBuffer({.SizeInBytes = *bytes, .Heap = rtapi::HeapType::kReadback});
  if (!buffer) return fail(buffer.error());
  auto list = device.CreateCommandList();
  if (!list) return fail(list.error());
  using rtapi::ResourceBarrier;
  using rtapi::ResourceStates;
  list->ResourceBarrier(
      ResourceBarrier::Transition(texture, ResourceStates::kCommon, ResourceStates::kCopySource));
  list->CopyTextureRegion({*buffer, layouts[0]}, 0, 0, 0, {texture, 0});
  list->ResourceBarrier(
      ResourceBarrier::Transition(texture, ResourceStates::kCopySource, ResourceStates::kCommon));
  if (const auto status = list->Close(); !status) return fail(status.error());
  if (!fence_) {
    const auto fence = device.CreateFence(0);
    if (!fence) return fail(fence.error());
    fence_ = *fence;
  }
  if (const auto status = queue.ExecuteCommandLists({*list}); !status) return fail(status.error());
  if (const auto status = queue.Signal(fence_, presented_ + 1); !status) {
    return fail(status.error());
  }
  copied_.push_back({presented_, desc_.Width, desc_.Height, desc_.Format,
                     layouts[0].Footprint.RowPitch, *buffer, presented_ + 1});
  return S_OK;
}

// A queue that waits for a fence has frames that are not drawn yet; they come with a later call.
void SwapChain::deliver_finished() {
  while (!copied_.empty() && fence_.GetCompletedValue() >= copied_.front().fence_value) {
    const Copied& copied = copied_.front();
    const auto bytes = copied.buffer.data<uint8_t>();
    const KaamosFrame frame = {copied.number,    copied.width, copied.height, copied.format,
                               copied.row_bytes, bytes.data(), window_};
    const rtapi::Status status = deliver_frame(frame, chain_);
    if (!status && !told_) fail(status.error());
    told_ = told_ || !status;
    copied_.pop_front();
  }
}

HRESULT SwapChain::ResizeBuffers(UINT count, UINT width, UINT height, DXGI_FORMAT format,
                                 UINT flags) {
  for (size_t i = 0; i < buffers_.size(); ++i) {
    buffers_[i]->AddRef();
    if (const ULONG left = buffers_[i]->Release(); left > 1) {
      return refuse("ResizeBuffers: back buffer " + std::to_string(i) + " has " +
                    std::to_string(left - 1) +
                    " references; release all of every back buffer, and what holds them.");
    }
  }
  if (((flags ^ desc_.Flags) & kLastingFlags) != 0) {
    return refuse("ResizeBuffers: SwapChainFlags is " + std::to_string(flags) +
                  "; the swap chain was made with " + std::to_string(desc_.Flags) +
                  ", and the flags for tearing and the waitable object stay.");
  }
  DXGI_SWAP_CHAIN_DESC1 changed = desc_;
  if (count != 0) changed.BufferCount = count;
  if (format != DXGI_FORMAT_UNKNOWN) changed.Format = format;
  changed.Width = width;
  changed.Height = height;
  changed.Flags = flags;
  fill_size(changed, window_);
  if (const std::string fault = find_fault(changed); !fault.empty()) {
    return refuse("ResizeBuffers: " + fault);
  }
  deliver_finished();
  return make_buffers(changed);
}

HRESULT SwapChain::ResizeBuffers1(UINT count, UINT width, UINT height, DXGI_FORMAT format,
                                  UINT flags, const UINT*, IUnknown* const* queues) {
  if (queues != nullptr) {
    for (UINT i = 0; i < (count != 0 ? count : desc_.BufferCount); ++i) {
      if (queues[i] != queue_.Get()) {
        return refuse("ResizeBuffers1: ppPresentQueue[" + std::to_string(i) +
                      "] is not the queue that the swap chain was made with.");
      }
    }
  }
  return ResizeBuffers(count, width, height, format, flags);
}

HRESULT SwapChain::ResizeTarget(const DXGI_MODE_DESC* mode) {
  if (mode == nullptr) return DXGI_ERROR_INVALID_CALL;
  if (window_ == nullptr) return S_OK;
  return SetWindowPos(window_, nullptr, 0, 0, static_cast<int>(mode->Width),
                      static_cast<int>(mode->Height), SWP_NOMOVE | SWP_NOZORDER)
             ? S_OK
             : DXGI_ERROR_INVALID_CALL;
}

HRESULT create_swap_chain(IUnknown* factory, IUnknown* queue, const DXGI_SWAP_CHAIN_DESC1& desc,
                          HWND window, REFIID riid, void** chain) {
  ComPtr<ID3D12CommandQueue> direct;
  ComPtr<ID3D12Device> device;
  if (queue != nullptr) {
    queue->QueryInterface(IID_ID3D12CommandQueue, reinterpret_cast<void**>(direct.GetAddressOf()));
    queue->QueryInterface(IID_ID3D12Device, reinterpret_cast<void**>(device.GetAddressOf()));
  }
  if (direct != nullptr) {
    direct->GetDevice(IID_ID3D12Device, reinterpret_cast<void**>(device.GetAddressOf()));
  }
  Reporter& reporter = device != nullptr ? reporter_of(device.Get()) : process_reporter();
  if (chain == nullptr) {
    return reporter.fail(ErrorId::kNullPointer, "CreateSwapChain: ppSwapChain.");
  }
  if (queue == nullptr) return reporter.fail(ErrorId::kNullPointer, "CreateSwapChain: pDevice.");
  if (direct == nullptr || direct->GetDesc().Type != D3D12_COMMAND_LIST_TYPE_DIRECT) {
    return refuse_call(
        reporter,
        "CreateSwapChain: pDevice is not a direct ID3D12CommandQueue; with D3D12 pass "
        "the queue that draws, not the device.");
  }
  if (const std::string fault = find_fault(desc); !fault.empty()) {
    return refuse_call(reporter, "CreateSwapChain: " + fault);
  }
  if (window != nullptr && !window_size(window)) {
    return refuse_call(reporter, "CreateSwapChain: OutputWindow is not a valid window.");
  }
  if (!claim_window(window)) {
    reporter.fail(ErrorId::kSwapChain,
                  "CreateSwapChain: the window has a swap chain; release that one first.");
    return E_ACCESSDENIED;
  }
  DXGI_SWAP_CHAIN_DESC1 sized = desc;
  fill_size(sized, window);
  auto* made = new SwapChain(factory, direct.Get(), sized, window);
  if (const HRESULT result = made->make_buffers(sized); FAILED(result)) {
    made->Release();
    return result;
  }
  return hand_out(made, riid, chain);
}

}  // namespace kaamos::d3d12
