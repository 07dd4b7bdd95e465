// SPDX-License-Identifier: MIT
// A device of the facade for tests, and the messages that it gave.
#pragma once

#include <windows.h>

#include <d3d12.h>
#include <d3dcompiler.h>
#include <dxguids/dxguids.h>
#include <gtest/gtest.h>
#include <wrl/client.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "d3d12/com/report_fixture.h"
#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

using Microsoft::WRL::ComPtr;

class D3d12Test : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(
        D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(device_.GetAddressOf())),
        S_OK);
    listener_.emplace(reporter_of(device_.Get()));
    D3D12_COMMAND_QUEUE_DESC queue = {};
    ASSERT_EQ(device_->CreateCommandQueue(&queue, IID_PPV_ARGS(queue_.GetAddressOf())), S_OK);
    ASSERT_EQ(device_->CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE_DIRECT,
                                              IID_PPV_ARGS(allocator_.GetAddressOf())),
              S_OK);
    ASSERT_EQ(device_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_DIRECT, allocator_.Get(),
                                         nullptr, IID_PPV_ARGS(list_.GetAddressOf())),
              S_OK);
  }

  // The errors of device_.
  std::vector<std::string>& messages() { return listener_->messages; }

  // Compiles the function "main".
  static ComPtr<ID3DBlob> compile(const char* profile, const std::string& text) {
    ComPtr<ID3DBlob> code, errors;
    EXPECT_EQ(D3DCompile(text.data(), text.size(), "shader.hlsl", nullptr, nullptr, "main", profile,
                         0, 0, code.GetAddressOf(), errors.GetAddressOf()),
              S_OK)
        << (errors ? static_cast<const char*>(errors->GetBufferPointer()) : "");
    return code;
  }

  ComPtr<ID3D12Resource> buffer(UINT64 bytes, D3D12_HEAP_TYPE type,
                                D3D12_RESOURCE_STATES state = D3D12_RESOURCE_STATE_COMMON,
                                D3D12_RESOURCE_FLAGS flags = D3D12_RESOURCE_FLAG_NONE) {
    return buffer_of(device_.Get(), bytes, type, state, flags);
  }

  static ComPtr<ID3D12Resource> buffer_of(ID3D12Device* device, UINT64 bytes, D3D12_HEAP_TYPE type,
                                          D3D12_RESOURCE_STATES state = D3D12_RESOURCE_STATE_COMMON,
                                          D3D12_RESOURCE_FLAGS flags = D3D12_RESOURCE_FLAG_NONE) {
    D3D12_HEAP_PROPERTIES heap = {};
    heap.Type = type;
    D3D12_RESOURCE_DESC desc = {};
    desc.Dimension = D3D12_RESOURCE_DIMENSION_BUFFER;
    desc.Width = bytes;
    desc.Height = desc.DepthOrArraySize = desc.MipLevels = 1;
    desc.SampleDesc.Count = 1;
    desc.Layout = D3D12_TEXTURE_LAYOUT_ROW_MAJOR;
    desc.Flags = flags;
    ComPtr<ID3D12Resource> out;
    EXPECT_EQ(device->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc, state, nullptr,
                                              IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    return out;
  }

  // Closes and runs the list, waits as programs do, and opens it again.
  void run() {
    ASSERT_EQ(list_->Close(), S_OK);
    ID3D12CommandList* lists[] = {list_.Get()};
    queue_->ExecuteCommandLists(1, lists);
    ComPtr<ID3D12Fence> fence;
    ASSERT_EQ(device_->CreateFence(0, D3D12_FENCE_FLAG_NONE, IID_PPV_ARGS(fence.GetAddressOf())),
              S_OK);
    ASSERT_EQ(queue_->Signal(fence.Get(), 1), S_OK);
    const HANDLE event = CreateEvent(nullptr, FALSE, FALSE, nullptr);
    ASSERT_EQ(fence->SetEventOnCompletion(1, event), S_OK);
    ASSERT_EQ(WaitForSingleObject(event, INFINITE), WAIT_OBJECT_0);
    CloseHandle(event);
    ASSERT_EQ(allocator_->Reset(), S_OK);
    ASSERT_EQ(list_->Reset(allocator_.Get(), nullptr), S_OK);
  }

  ComPtr<ID3D12Device5> device_;
  ComPtr<ID3D12CommandQueue> queue_;
  ComPtr<ID3D12CommandAllocator> allocator_;
  ComPtr<ID3D12GraphicsCommandList4> list_;

 private:
  Quiet quiet_;
  std::optional<Listener> listener_;
};

// A test that runs on every backend: an instance of each fixture for "embree" and "vulkan".
class D3d12BackendTest : public D3d12Test, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    setenv("KAAMOS_BACKEND", GetParam(), 1);
    ComPtr<ID3D12Device> probe;
    if (FAILED(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_11_0,
                                 IID_PPV_ARGS(probe.GetAddressOf())))) {
      GTEST_SKIP() << "no device: " << GetParam();
    }
    D3d12Test::SetUp();
  }
  void TearDown() override { unsetenv("KAAMOS_BACKEND"); }

  static D3D12_RESOURCE_DESC texture_desc(UINT width, UINT height, UINT16 depth,
                                          DXGI_FORMAT format) {
    D3D12_RESOURCE_DESC desc = {};
    desc.Dimension =
        depth > 1 ? D3D12_RESOURCE_DIMENSION_TEXTURE3D : D3D12_RESOURCE_DIMENSION_TEXTURE2D;
    desc.Width = width;
    desc.Height = height;
    desc.DepthOrArraySize = depth;
    desc.MipLevels = 1;
    desc.Format = format;
    desc.SampleDesc.Count = 1;
    return desc;
  }
};

}  // namespace kaamos::d3d12
