// SPDX-License-Identifier: MIT
#include <dxgi1_6.h>
#include <kaamos_present.h>
#include <png.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "d3d12/objects/d3d12_fixture.h"
#include "d3d12/win32/window.h"

namespace kaamos::d3d12 {
namespace {

namespace fs = std::filesystem;

// Closes when it is told to, as programs do.
LRESULT CALLBACK window_procedure(HWND window, UINT message, WPARAM w, LPARAM l) {
  if (message == WM_DESTROY) PostQuitMessage(0);
  return DefWindowProcW(window, message, w, l);
}

class SwapChainTest : public D3d12Test {
 protected:
  void SetUp() override {
    D3d12Test::SetUp();
    WNDCLASSEXW kind = {};
    kind.cbSize = sizeof(kind);
    kind.lpfnWndProc = window_procedure;
    kind.lpszClassName = L"SwapChainTest";
    RegisterClassExW(&kind);
    window_ = CreateWindowExW(0, L"SwapChainTest", L"frames", WS_POPUP, 0, 0, 32, 16, nullptr,
                              nullptr, nullptr, nullptr);
    ASSERT_NE(window_, nullptr);
    ASSERT_EQ(CreateDXGIFactory1(__uuidof(IDXGIFactory4),
                                 reinterpret_cast<void**>(factory_.GetAddressOf())),
              S_OK);
    folder_ = fs::temp_directory_path() / ("kaamos_present_" + std::to_string(getpid()));
    fs::remove_all(folder_);
  }

  void TearDown() override {
    chain_.Reset();
    if (IsWindow(window_)) DestroyWindow(window_);
    MSG message;
    while (PeekMessageW(&message, nullptr, 0, 0, PM_REMOVE)) continue;
    UnregisterClassW(L"SwapChainTest", nullptr);
    unsetenv("KAAMOS_PRESENT");
    unsetenv("KAAMOS_PRESENT_EVERY");
    fs::remove_all(folder_);
    D3d12Test::TearDown();
  }

  static DXGI_SWAP_CHAIN_DESC1 good_desc() {
    DXGI_SWAP_CHAIN_DESC1 desc = {};
    desc.Format = DXGI_FORMAT_R8G8B8A8_UNORM;
    desc.SampleDesc.Count = 1;
    desc.BufferUsage = DXGI_USAGE_RENDER_TARGET_OUTPUT;
    desc.BufferCount = 2;
    desc.SwapEffect = DXGI_SWAP_EFFECT_FLIP_DISCARD;
    return desc;
  }

  HRESULT create(const DXGI_SWAP_CHAIN_DESC1& desc) {
    ComPtr<IDXGISwapChain1> made;
    const HRESULT result = factory_->CreateSwapChainForHwnd(queue_.Get(), window_, &desc, nullptr,
                                                            nullptr, made.GetAddressOf());
    if (SUCCEEDED(result)) made.As(&chain_);
    return result;
  }

  // Clears the current back buffer and presents it.
  void draw(const float (&color)[4]) {
    ComPtr<ID3D12Resource> buffer;
    ASSERT_EQ(chain_->GetBuffer(chain_->GetCurrentBackBufferIndex(), __uuidof(ID3D12Resource),
                                reinterpret_cast<void**>(buffer.GetAddressOf())),
              S_OK);
    if (heap_.Get() == nullptr) {
      D3D12_DESCRIPTOR_HEAP_DESC heap = {};
      heap.Type = D3D12_DESCRIPTOR_HEAP_TYPE_RTV;
      heap.NumDescriptors = 1;
      ASSERT_EQ(device_->CreateDescriptorHeap(&heap, __uuidof(ID3D12DescriptorHeap),
                                              reinterpret_cast<void**>(heap_.GetAddressOf())),
                S_OK);
    }
    const auto view = heap_->GetCPUDescriptorHandleForHeapStart();
    device_->CreateRenderTargetView(buffer.Get(), nullptr, view);
    transition(buffer.Get(), D3D12_RESOURCE_STATE_PRESENT, D3D12_RESOURCE_STATE_RENDER_TARGET);
    list_->ClearRenderTargetView(view, color, 0, nullptr);
    transition(buffer.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_PRESENT);
    ASSERT_EQ(list_->Close(), S_OK);
    ID3D12CommandList* lists[] = {list_.Get()};
    queue_->ExecuteCommandLists(1, lists);
    ASSERT_EQ(list_->Reset(allocator_.Get(), nullptr), S_OK);
  }

  void transition(ID3D12Resource* resource, D3D12_RESOURCE_STATES before,
                  D3D12_RESOURCE_STATES after) {
    D3D12_RESOURCE_BARRIER barrier = {};
    barrier.Transition = {resource, D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES, before, after};
    list_->ResourceBarrier(1, &barrier);
  }

  // The first pixel of a frame's file; empty without one.
  std::vector<int> first_pixel(const std::string& name) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, (folder_ / name).c_str())) return {};
    image.format = PNG_FORMAT_RGB;
    std::vector<uint8_t> rgb(PNG_IMAGE_SIZE(image));
    png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr);
    EXPECT_EQ(image.width, 32u);
    EXPECT_EQ(image.height, 16u);
    return {rgb[0], rgb[1], rgb[2]};
  }

  HWND window_ = nullptr;
  ComPtr<IDXGIFactory4> factory_;
  ComPtr<IDXGISwapChain3> chain_;
  ComPtr<ID3D12DescriptorHeap> heap_;
  fs::path folder_;
};

TEST_F(SwapChainTest, HasTheSizeOfItsWindow) {
  ASSERT_EQ(create(good_desc()), S_OK);
  DXGI_SWAP_CHAIN_DESC1 desc;
  ASSERT_EQ(chain_->GetDesc1(&desc), S_OK);
  EXPECT_EQ(desc.Width, 32u);
  EXPECT_EQ(desc.Height, 16u);
  HWND window = nullptr;
  EXPECT_EQ(chain_->GetHwnd(&window), S_OK);
  EXPECT_EQ(window, window_);
  ComPtr<ID3D12Device> device;
  EXPECT_EQ(
      chain_->GetDevice(__uuidof(ID3D12Device), reinterpret_cast<void**>(device.GetAddressOf())),
      S_OK);
  EXPECT_EQ(device.Get(), device_.Get());
}

TEST_F(SwapChainTest, WritesPresentedFrames) {
  setenv("KAAMOS_PRESENT", folder_.c_str(), 1);
  setenv("KAAMOS_PRESENT_EVERY", "2", 1);
  ASSERT_EQ(create(good_desc()), S_OK);
  const float colors[3][4] = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0.2F, 1, 1}};
  for (UINT i = 0; i < 3; ++i) {
    EXPECT_EQ(chain_->GetCurrentBackBufferIndex(), i % 2);
    draw(colors[i]);
    ASSERT_EQ(chain_->Present(1, 0), S_OK);
  }
  // Other tests of this process may have had swap chains before.
  std::string prefix;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    prefix = name.substr(0, name.find("frame_"));
  }
  EXPECT_EQ(first_pixel(prefix + "frame_00000.png"), (std::vector<int>{255, 0, 0}));
  EXPECT_EQ(first_pixel(prefix + "frame_00001.png"), std::vector<int>{});
  EXPECT_EQ(first_pixel(prefix + "frame_00002.png"), (std::vector<int>{0, 51, 255}));
  UINT count = 0;
  EXPECT_EQ(chain_->GetLastPresentCount(&count), S_OK);
  EXPECT_EQ(count, 3u);
}

struct Seen {
  UINT64 frames = 0;
  std::vector<uint8_t> pixel;
  DXGI_FORMAT format = DXGI_FORMAT_UNKNOWN;
};

void see(const KaamosFrame* frame, void* user) {
  auto* seen = static_cast<Seen*>(user);
  ++seen->frames;
  seen->format = frame->format;
  const auto* bytes = static_cast<const uint8_t*>(frame->pixels);
  seen->pixel.assign(bytes, bytes + 4);
}

TEST_F(SwapChainTest, HandsFramesToTheCallback) {
  Seen seen;
  kaamos_on_present(&see, &seen);
  DXGI_SWAP_CHAIN_DESC1 desc = good_desc();
  desc.Format = DXGI_FORMAT_B8G8R8A8_UNORM;
  ASSERT_EQ(create(desc), S_OK);
  draw({1, 0.4F, 0, 1});
  EXPECT_EQ(chain_->Present(0, DXGI_PRESENT_TEST), S_OK);
  EXPECT_EQ(seen.frames, 0u);
  EXPECT_EQ(chain_->Present(0, 0), S_OK);
  kaamos_on_present(nullptr, nullptr);
  EXPECT_EQ(seen.frames, 1u);
  EXPECT_EQ(seen.format, DXGI_FORMAT_B8G8R8A8_UNORM);
  EXPECT_EQ(seen.pixel, (std::vector<uint8_t>{0, 102, 255, 255}));
}

TEST_F(SwapChainTest, AFrameOfAWaitingQueueComesWhenItIsDrawn) {
  Seen seen;
  kaamos_on_present(&see, &seen);
  ASSERT_EQ(create(good_desc()), S_OK);
  ComPtr<ID3D12Fence> fence;
  ASSERT_EQ(device_->CreateFence(0, D3D12_FENCE_FLAG_NONE, __uuidof(ID3D12Fence),
                                 reinterpret_cast<void**>(fence.GetAddressOf())),
            S_OK);
  ASSERT_EQ(queue_->Wait(fence.Get(), 1), S_OK);
  draw({0, 1, 0, 1});
  ASSERT_EQ(chain_->Present(0, 0), S_OK);
  EXPECT_EQ(seen.frames, 0u);
  ASSERT_EQ(fence->Signal(1), S_OK);
  chain_.Reset();
  kaamos_on_present(nullptr, nullptr);
  EXPECT_EQ(seen.frames, 1u);
  EXPECT_EQ(seen.pixel, (std::vector<uint8_t>{0, 255, 0, 255}));
}

TEST_F(SwapChainTest, ClosesItsWindowAfterTheLastFrame) {
  ASSERT_EQ(create(good_desc()), S_OK);
  int presented = 0;
  MSG message = {};
  while (message.message != WM_QUIT && presented < 2 * frame_limit()) {
    if (PeekMessageW(&message, nullptr, 0, 0, PM_REMOVE)) {
      DispatchMessageW(&message);
    } else {
      ASSERT_EQ(chain_->Present(1, 0), S_OK);
      ++presented;
    }
  }
  EXPECT_EQ(presented, frame_limit());
}

TEST_F(SwapChainTest, AWindowHasOneSwapChain) {
  ASSERT_EQ(create(good_desc()), S_OK);
  const ComPtr<IDXGISwapChain3> first = chain_;
  EXPECT_EQ(create(good_desc()), E_ACCESSDENIED);
  EXPECT_EQ(messages().size(), 1u);
}

TEST_F(SwapChainTest, ItsMessagesAreThoseOfItsDevice) {
  ComPtr<ID3D12Device> other;
  ASSERT_EQ(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(other.GetAddressOf())),
            S_OK);
  const Listener to_other(reporter_of(other.Get()));
  const Listener to_none;
  ASSERT_EQ(create(good_desc()), S_OK);
  EXPECT_EQ(chain_->Present(5, 0), DXGI_ERROR_INVALID_CALL);
  EXPECT_EQ(messages().size(), 1u);
  EXPECT_EQ(to_other.messages.size() + to_none.messages.size(), 0u);
  ComPtr<IDXGISwapChain1> made;
  EXPECT_EQ(factory_->CreateSwapChainForHwnd(queue_.Get(), window_, nullptr, nullptr, nullptr,
                                             made.GetAddressOf()),
            E_INVALIDARG);
  EXPECT_EQ(to_none.messages.size(), 1u);
  EXPECT_EQ(to_other.messages.size(), 0u);
}

TEST_F(SwapChainTest, RefusesWhatTheFlipModelRefuses) {
  const auto refused = [&](auto change, const char* part) {
    DXGI_SWAP_CHAIN_DESC1 desc = good_desc();
    change(desc);
    messages().clear();
    EXPECT_EQ(create(desc), DXGI_ERROR_INVALID_CALL);
    ASSERT_EQ(messages().size(), 1u) << part;
    EXPECT_NE(messages()[0].find(part), std::string::npos) << messages()[0];
  };
  refused([](auto& d) { d.BufferCount = 1; }, "BufferCount is 1");
  refused([](auto& d) { d.BufferCount = 17; }, "BufferCount is 17");
  refused([](auto& d) { d.SwapEffect = DXGI_SWAP_EFFECT_DISCARD; }, "SwapEffect is 0");
  refused([](auto& d) { d.SampleDesc.Count = 4; }, "SampleDesc is {4, 0}");
  refused([](auto& d) { d.Format = DXGI_FORMAT_R8G8B8A8_UNORM_SRGB; }, "Format is 29");
  ComPtr<IDXGISwapChain1> made;
  const DXGI_SWAP_CHAIN_DESC1 desc = good_desc();
  messages().clear();
  EXPECT_EQ(factory_->CreateSwapChainForHwnd(device_.Get(), window_, &desc, nullptr, nullptr,
                                             made.GetAddressOf()),
            DXGI_ERROR_INVALID_CALL);
  EXPECT_NE(messages().at(0).find("not a direct ID3D12CommandQueue"), std::string::npos);
  EXPECT_EQ(
      factory_->CreateSwapChainForComposition(queue_.Get(), &desc, nullptr, made.GetAddressOf()),
      DXGI_ERROR_INVALID_CALL);
  EXPECT_NE(messages().at(1).find("0 x 0"), std::string::npos);
}

TEST_F(SwapChainTest, ResizesOnceItsBuffersAreReleased) {
  ASSERT_EQ(create(good_desc()), S_OK);
  ComPtr<ID3D12Resource> buffer;
  ASSERT_EQ(chain_->GetBuffer(1, __uuidof(ID3D12Resource),
                              reinterpret_cast<void**>(buffer.GetAddressOf())),
            S_OK);
  EXPECT_EQ(chain_->ResizeBuffers(3, 64, 48, DXGI_FORMAT_UNKNOWN, 0), DXGI_ERROR_INVALID_CALL);
  EXPECT_NE(messages().at(0).find("back buffer 1 has 1 references"), std::string::npos);
  buffer.Reset();
  EXPECT_EQ(
      chain_->ResizeBuffers(3, 64, 48, DXGI_FORMAT_UNKNOWN, DXGI_SWAP_CHAIN_FLAG_ALLOW_TEARING),
      DXGI_ERROR_INVALID_CALL);
  ASSERT_EQ(chain_->ResizeBuffers(3, 64, 48, DXGI_FORMAT_UNKNOWN, 0), S_OK);
  ASSERT_EQ(chain_->GetBuffer(2, __uuidof(ID3D12Resource),
                              reinterpret_cast<void**>(buffer.GetAddressOf())),
            S_OK);
  EXPECT_EQ(buffer->GetDesc().Width, 64u);
  EXPECT_EQ(buffer->GetDesc().Height, 48u);
  ComPtr<ID3D12Resource> beyond;
  EXPECT_EQ(chain_->GetBuffer(3, __uuidof(ID3D12Resource),
                              reinterpret_cast<void**>(beyond.GetAddressOf())),
            DXGI_ERROR_INVALID_CALL);
}

TEST_F(SwapChainTest, PresentsOnlyAsItsFlagsAllow) {
  DXGI_SWAP_CHAIN_DESC1 desc = good_desc();
  desc.Flags = DXGI_SWAP_CHAIN_FLAG_FRAME_LATENCY_WAITABLE_OBJECT;
  ASSERT_EQ(create(desc), S_OK);
  EXPECT_EQ(chain_->Present(5, 0), DXGI_ERROR_INVALID_CALL);
  EXPECT_EQ(chain_->Present(0, DXGI_PRESENT_ALLOW_TEARING), DXGI_ERROR_INVALID_CALL);
  EXPECT_EQ(chain_->SetFullscreenState(TRUE, nullptr), DXGI_ERROR_NOT_CURRENTLY_AVAILABLE);
  const HANDLE waitable = chain_->GetFrameLatencyWaitableObject();
  EXPECT_EQ(WaitForSingleObject(waitable, 0), WAIT_OBJECT_0);
  EXPECT_TRUE(CloseHandle(waitable));
  UINT support = 0;
  EXPECT_EQ(chain_->CheckColorSpaceSupport(DXGI_COLOR_SPACE_RGB_FULL_G22_NONE_P709, &support),
            S_OK);
  EXPECT_EQ(support, UINT{DXGI_SWAP_CHAIN_COLOR_SPACE_SUPPORT_FLAG_PRESENT});
  EXPECT_EQ(chain_->SetColorSpace1(DXGI_COLOR_SPACE_RGB_FULL_G2084_NONE_P2020),
            DXGI_ERROR_INVALID_CALL);
}

TEST_F(SwapChainTest, AFolderThatCannotBeMadeIsToldOnce) {
  setenv("KAAMOS_PRESENT", "/proc/kaamos", 1);
  ASSERT_EQ(create(good_desc()), S_OK);
  messages().clear();
  for (int i = 0; i < 2; ++i) EXPECT_EQ(chain_->Present(0, 0), S_OK);
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_NE(messages()[0].find("/proc/kaamos/"), std::string::npos);
}

TEST_F(SwapChainTest, StaysAsItWasWhenAResizeFails) {
  ASSERT_EQ(create(good_desc()), S_OK);
  DXGI_SWAP_CHAIN_DESC before = {};
  ASSERT_EQ(chain_->GetDesc(&before), S_OK);
  EXPECT_LT(chain_->ResizeBuffers(0, 20000, 100, DXGI_FORMAT_UNKNOWN, 0), 0);
  EXPECT_FALSE(messages().empty());
  DXGI_SWAP_CHAIN_DESC desc = {};
  ASSERT_EQ(chain_->GetDesc(&desc), S_OK);
  EXPECT_EQ(desc.BufferDesc.Width, before.BufferDesc.Width);
  EXPECT_EQ(chain_->Present(0, 0), S_OK);
  EXPECT_EQ(chain_->Present(0, 0), S_OK);
}

}  // namespace
}  // namespace kaamos::d3d12
