// SPDX-License-Identifier: MIT
// The triangle of ../01-triangle in a window: DXGI's adapter and swap chain, and a message loop.
#include <dxgi1_6.h>

#include <stdexcept>

#include "..\01-triangle\triangle.h"

namespace {

constexpr UINT kBuffers = 2;

class WindowedTriangle : public Triangle {
 public:
  WindowedTriangle(const Options& options, HWND window) : Triangle(options) {
    ComPtr<IDXGIFactory4> factory;
    CHECK(CreateDXGIFactory2(DXGI_CREATE_FACTORY_DEBUG, IID_PPV_ARGS(&factory)));
    DXGI_SWAP_CHAIN_DESC1 desc = {};
    desc.Width = options.width;
    desc.Height = options.height;
    desc.Format = DXGI_FORMAT_R8G8B8A8_UNORM;
    desc.SampleDesc.Count = 1;
    desc.BufferUsage = DXGI_USAGE_RENDER_TARGET_OUTPUT;
    desc.BufferCount = kBuffers;
    desc.SwapEffect = DXGI_SWAP_EFFECT_FLIP_DISCARD;
    ComPtr<IDXGISwapChain1> swap_chain;
    CHECK(factory->CreateSwapChainForHwnd(queue_.Get(), window, &desc, nullptr, nullptr,
                                          &swap_chain));
    CHECK(factory->MakeWindowAssociation(window, DXGI_MWA_NO_ALT_ENTER));
    CHECK(swap_chain.As(&swap_chain_));
    for (UINT i = 0; i < kBuffers; ++i) {
      CHECK(swap_chain_->GetBuffer(i, IID_PPV_ARGS(&back_buffers_[i])));
    }
  }

  void Render() {
    DispatchRays();
    ID3D12Resource* back_buffer = back_buffers_[swap_chain_->GetCurrentBackBufferIndex()].Get();
    const D3D12_RESOURCE_BARRIER before[] = {
        CD3DX12_RESOURCE_BARRIER::Transition(image(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                                             D3D12_RESOURCE_STATE_COPY_SOURCE),
        CD3DX12_RESOURCE_BARRIER::Transition(back_buffer, D3D12_RESOURCE_STATE_PRESENT,
                                             D3D12_RESOURCE_STATE_COPY_DEST)};
    list_->ResourceBarrier(_countof(before), before);
    list_->CopyResource(back_buffer, image());
    const D3D12_RESOURCE_BARRIER after[] = {
        CD3DX12_RESOURCE_BARRIER::Transition(image(), D3D12_RESOURCE_STATE_COPY_SOURCE,
                                             D3D12_RESOURCE_STATE_UNORDERED_ACCESS),
        CD3DX12_RESOURCE_BARRIER::Transition(back_buffer, D3D12_RESOURCE_STATE_COPY_DEST,
                                             D3D12_RESOURCE_STATE_PRESENT)};
    list_->ResourceBarrier(_countof(after), after);
    Execute();
    CHECK(swap_chain_->Present(1, 0));
  }

 private:
  ComPtr<IDXGISwapChain3> swap_chain_;
  ComPtr<ID3D12Resource> back_buffers_[kBuffers];
};

LRESULT CALLBACK WindowProcedure(HWND window, UINT message, WPARAM wparam, LPARAM lparam) {
  auto* triangle = reinterpret_cast<WindowedTriangle*>(GetWindowLongPtrW(window, GWLP_USERDATA));
  switch (message) {
    case WM_PAINT:
      if (triangle != nullptr) triangle->Render();
      return 0;
    case WM_DESTROY:
      PostQuitMessage(0);
      return 0;
    default:
      return DefWindowProcW(window, message, wparam, lparam);
  }
}

int Run(HINSTANCE instance, int show) {
  Options options;
  WNDCLASSEXW kind = {};
  kind.cbSize = sizeof(kind);
  kind.style = CS_HREDRAW | CS_VREDRAW;
  kind.lpfnWndProc = WindowProcedure;
  kind.hInstance = instance;
  kind.hCursor = LoadCursor(nullptr, IDC_ARROW);
  kind.lpszClassName = L"TriangleWindow";
  if (RegisterClassExW(&kind) == 0) throw std::runtime_error("no window class");
  RECT size = {0, 0, static_cast<LONG>(options.width), static_cast<LONG>(options.height)};
  AdjustWindowRect(&size, WS_OVERLAPPEDWINDOW, FALSE);
  const HWND window = CreateWindowExW(0, kind.lpszClassName, L"A triangle", WS_OVERLAPPEDWINDOW,
                                      CW_USEDEFAULT, CW_USEDEFAULT, size.right - size.left,
                                      size.bottom - size.top, nullptr, nullptr, instance, nullptr);
  if (window == nullptr) throw std::runtime_error("no window");
  WindowedTriangle triangle(options, window);
  SetWindowLongPtrW(window, GWLP_USERDATA, reinterpret_cast<LONG_PTR>(&triangle));
  ShowWindow(window, show);

  MSG message = {};
  while (GetMessageW(&message, nullptr, 0, 0) > 0) {
    TranslateMessage(&message);
    DispatchMessageW(&message);
  }
  return static_cast<int>(message.wParam);
}

}  // namespace

int WINAPI WinMain(HINSTANCE instance, HINSTANCE, LPSTR, int show) {
  try {
    return Run(instance, show);
  } catch (const std::exception& error) {
    OutputDebugStringA(error.what());
    return EXIT_FAILURE;
  }
}
