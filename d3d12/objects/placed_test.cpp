// SPDX-License-Identifier: MIT
// Resources that share the bytes of a heap, within a device and between two, on each backend.
// [D3D12: memory aliasing and data inheritance; CreateSharedHandle, OpenSharedHandle]
#include <directx/d3dx12.h>

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

using testing::Each;

constexpr UINT64 kBytes = 1 << 20;
constexpr UINT kSide = 64;
constexpr UINT kTexels = kSide * kSide;

class PlacedResources : public D3d12BackendTest {
 protected:
  template <class Interface = ID3D12Heap>
  ComPtr<Interface> heap(D3D12_HEAP_TYPE type, D3D12_HEAP_FLAGS flags = D3D12_HEAP_FLAG_NONE) {
    const CD3DX12_HEAP_DESC desc(kBytes, type, 0, flags);
    ComPtr<Interface> out;
    EXPECT_EQ(device_->CreateHeap(&desc, IID_PPV_ARGS(out.GetAddressOf())), S_OK);
    return out;
  }
  static ComPtr<ID3D12Resource> place(ID3D12Device* device, ID3D12Heap* heap, UINT64 offset,
                                      const D3D12_RESOURCE_DESC& desc,
                                      D3D12_RESOURCE_STATES state) {
    ComPtr<ID3D12Resource> out;
    EXPECT_EQ(device->CreatePlacedResource(heap, offset, &desc, state, nullptr,
                                           IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    return out;
  }
  ComPtr<ID3D12Resource> place(ID3D12Heap* heap, UINT64 offset, const D3D12_RESOURCE_DESC& desc,
                               D3D12_RESOURCE_STATES state) {
    return place(device_.Get(), heap, offset, desc, state);
  }
  ComPtr<ID3D12Resource> target(ID3D12Heap* heap, UINT64 offset, DXGI_FORMAT format) {
    D3D12_RESOURCE_DESC desc = texture_desc(kSide, kSide, 1, format);
    desc.Flags = D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET;
    return place(heap, offset, desc, D3D12_RESOURCE_STATE_RENDER_TARGET);
  }

  void clear(ID3D12Resource* target, const float (&color)[4]) {
    const D3D12_DESCRIPTOR_HEAP_DESC desc = {D3D12_DESCRIPTOR_HEAP_TYPE_RTV, 1,
                                             D3D12_DESCRIPTOR_HEAP_FLAG_NONE, 0};
    ComPtr<ID3D12DescriptorHeap> views;
    ASSERT_EQ(device_->CreateDescriptorHeap(&desc, IID_PPV_ARGS(views.GetAddressOf())), S_OK);
    const auto view = views->GetCPUDescriptorHandleForHeapStart();
    device_->CreateRenderTargetView(target, nullptr, view);
    list_->ClearRenderTargetView(view, color, 0, nullptr);
    run();
  }
  void alias(ID3D12Resource* before, ID3D12Resource* after) {
    const auto barrier = CD3DX12_RESOURCE_BARRIER::Aliasing(before, after);
    list_->ResourceBarrier(1, &barrier);
  }

  // The words of a buffer that copies can read, or of a texture in state RENDER_TARGET.
  std::vector<UINT> words(ID3D12Resource* from, size_t count) {
    const auto read = buffer(count * 4, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
    if (from->GetDesc().Dimension == D3D12_RESOURCE_DIMENSION_BUFFER) {
      list_->CopyBufferRegion(read.Get(), 0, from, 0, count * 4);
    } else {
      const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(
          from, D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_SOURCE);
      list_->ResourceBarrier(1, &barrier);
      D3D12_PLACED_SUBRESOURCE_FOOTPRINT layout = {};
      const D3D12_RESOURCE_DESC desc = from->GetDesc();
      device_->GetCopyableFootprints(&desc, 0, 1, 0, &layout, nullptr, nullptr, nullptr);
      const CD3DX12_TEXTURE_COPY_LOCATION dest(read.Get(), layout);
      const CD3DX12_TEXTURE_COPY_LOCATION source(from, 0);
      list_->CopyTextureRegion(&dest, 0, 0, 0, &source, nullptr);
    }
    run();
    void* bytes = nullptr;
    EXPECT_EQ(read->Map(0, nullptr, &bytes), S_OK);
    const auto* first = static_cast<const UINT*>(bytes);
    return {first, first + count};
  }

  static UINT* map(ID3D12Resource* resource) {
    void* bytes = nullptr;
    EXPECT_EQ(resource->Map(0, nullptr, &bytes), S_OK);
    return static_cast<UINT*>(bytes);
  }
};

TEST_P(PlacedResources, BuffersThatOverlapShareBytes) {
  const auto memory = heap(D3D12_HEAP_TYPE_UPLOAD);
  const auto first = place(memory.Get(), 0, CD3DX12_RESOURCE_DESC::Buffer(131072),
                           D3D12_RESOURCE_STATE_GENERIC_READ);
  const auto second = place(memory.Get(), 65536, CD3DX12_RESOURCE_DESC::Buffer(131072),
                            D3D12_RESOURCE_STATE_GENERIC_READ);
  UINT* low = map(first.Get());
  UINT* high = map(second.Get());
  low[65536 / 4] = 7;
  high[1] = 8;
  EXPECT_EQ(high[0], 7u);
  EXPECT_EQ(low[65536 / 4 + 1], 8u);
  EXPECT_EQ(words(second.Get(), 2), (std::vector<UINT>{7, 8})) << "as copies see it";
  EXPECT_EQ(first->GetGPUVirtualAddress() % 65536, 0u);
  EXPECT_EQ(second->GetGPUVirtualAddress() % 65536, 0u);
  EXPECT_TRUE(messages().empty());
}

TEST_P(PlacedResources, ABufferSeesTheTexelsThatLieInItsPlace) {
  const auto memory = heap(D3D12_HEAP_TYPE_DEFAULT);
  const auto texture = target(memory.Get(), 65536, DXGI_FORMAT_R32_UINT);
  const auto bytes = place(memory.Get(), 65536, CD3DX12_RESOURCE_DESC::Buffer(kTexels * 4),
                           D3D12_RESOURCE_STATE_COPY_SOURCE);
  clear(texture.Get(), {1234, 0, 0, 0});
  alias(texture.Get(), bytes.Get());
  EXPECT_THAT(words(bytes.Get(), kTexels), Each(1234u));
  EXPECT_TRUE(messages().empty());
}

TEST_P(PlacedResources, TexturesOfOneDescInheritTexels) {
  const auto memory = heap(D3D12_HEAP_TYPE_DEFAULT);
  const auto first = target(memory.Get(), 0, DXGI_FORMAT_R8G8B8A8_UNORM);
  const auto second = target(memory.Get(), 0, DXGI_FORMAT_R8G8B8A8_UNORM);
  const auto other = target(memory.Get(), 65536, DXGI_FORMAT_R8G8B8A8_UNORM);
  clear(first.Get(), {1, 0, 0, 1});
  clear(other.Get(), {0, 1, 0, 1});
  alias(first.Get(), second.Get());
  EXPECT_THAT(words(second.Get(), kTexels), Each(0xFF0000FFu));
  EXPECT_THAT(words(other.Get(), kTexels), Each(0xFF00FF00u)) << "beside them";
  EXPECT_TRUE(messages().empty());
}

// Its blocks are decoded when they are written through it alone.
TEST_P(PlacedResources, BlocksHaveMemoryOfTheirOwn) {
  const auto memory = heap(D3D12_HEAP_TYPE_DEFAULT);
  const auto texture = place(memory.Get(), 0, texture_desc(kSide, kSide, 1, DXGI_FORMAT_BC1_UNORM),
                             D3D12_RESOURCE_STATE_COMMON);
  EXPECT_NE(texture, nullptr);
  EXPECT_TRUE(messages().empty());
}

TEST_P(PlacedResources, AResourceOutlivesItsHeap) {
  auto memory = heap(D3D12_HEAP_TYPE_UPLOAD);
  const auto bytes =
      place(memory.Get(), 0, CD3DX12_RESOURCE_DESC::Buffer(4), D3D12_RESOURCE_STATE_GENERIC_READ);
  map(bytes.Get())[0] = 5;
  memory.Reset();
  EXPECT_EQ(words(bytes.Get(), 1), std::vector<UINT>{5});
}

TEST_P(PlacedResources, PlacesAreCheckedAgainstSizeAndAlignment) {
  const auto memory = heap(D3D12_HEAP_TYPE_DEFAULT);
  const auto desc = CD3DX12_RESOURCE_DESC::Buffer(131072);
  ComPtr<ID3D12Resource> out;
  for (const UINT64 offset : {UINT64{4096}, kBytes - 65536, kBytes, UINT64_MAX - 65535}) {
    EXPECT_EQ(
        device_->CreatePlacedResource(memory.Get(), offset, &desc, D3D12_RESOURCE_STATE_COMMON,
                                      nullptr, IID_PPV_ARGS(out.ReleaseAndGetAddressOf())),
        E_INVALIDARG)
        << offset;
  }
  ASSERT_EQ(messages().size(), 4u);
  for (const std::string& message : messages()) EXPECT_NE(message.find("KA0576"), message.npos);
}

class SharedResources : public PlacedResources {
 protected:
  void SetUp() override {
    PlacedResources::SetUp();
    if (IsSkipped()) return;
    ASSERT_EQ(
        D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_11_0, IID_PPV_ARGS(other_.GetAddressOf())),
        S_OK);
  }
  template <class Object>
  ComPtr<Object> open_on_other(ID3D12DeviceChild* object) {
    HANDLE handle = nullptr;
    EXPECT_EQ(device_->CreateSharedHandle(object, nullptr, GENERIC_ALL, nullptr, &handle), S_OK);
    ComPtr<Object> out;
    EXPECT_EQ(other_->OpenSharedHandle(handle, IID_PPV_ARGS(out.GetAddressOf())), S_OK);
    EXPECT_TRUE(CloseHandle(handle));
    return out;
  }

  ComPtr<ID3D12Device> other_;
};

TEST_P(SharedResources, AHeapIsOneMemoryOnBothDevices) {
  const auto memory = heap(D3D12_HEAP_TYPE_DEFAULT, D3D12_HEAP_FLAG_SHARED);
  const auto opened = open_on_other<ID3D12Heap>(memory.Get());
  ComPtr<ID3D12Device> device;
  ASSERT_EQ(opened->GetDevice(IID_PPV_ARGS(device.GetAddressOf())), S_OK);
  EXPECT_EQ(device, other_);
  EXPECT_EQ(opened->GetDesc().SizeInBytes, kBytes);
  const auto desc = CD3DX12_RESOURCE_DESC::Buffer(kTexels * 4);
  const auto there = place(other_.Get(), opened.Get(), 0, desc, D3D12_RESOURCE_STATE_COPY_SOURCE);
  const auto here = target(memory.Get(), 0, DXGI_FORMAT_R32_UINT);
  clear(here.Get(), {99, 0, 0, 0});

  ComPtr<ID3D12CommandQueue> queue;
  ComPtr<ID3D12CommandAllocator> allocator;
  ComPtr<ID3D12GraphicsCommandList> list;
  const D3D12_COMMAND_QUEUE_DESC queue_desc = {};
  ASSERT_EQ(other_->CreateCommandQueue(&queue_desc, IID_PPV_ARGS(queue.GetAddressOf())), S_OK);
  ASSERT_EQ(other_->CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE_DIRECT,
                                           IID_PPV_ARGS(allocator.GetAddressOf())),
            S_OK);
  ASSERT_EQ(other_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_DIRECT, allocator.Get(), nullptr,
                                      IID_PPV_ARGS(list.GetAddressOf())),
            S_OK);
  const auto read = buffer_of(other_.Get(), kTexels * 4, D3D12_HEAP_TYPE_READBACK,
                              D3D12_RESOURCE_STATE_COPY_DEST);
  list->CopyBufferRegion(read.Get(), 0, there.Get(), 0, kTexels * 4);
  ASSERT_EQ(list->Close(), S_OK);
  ID3D12CommandList* lists[] = {list.Get()};
  queue->ExecuteCommandLists(1, lists);

  // A fence of one device that the queue of the other signals.
  ComPtr<ID3D12Fence> fence;
  ASSERT_EQ(device_->CreateFence(0, D3D12_FENCE_FLAG_SHARED, IID_PPV_ARGS(fence.GetAddressOf())),
            S_OK);
  const auto other_fence = open_on_other<ID3D12Fence>(fence.Get());
  ASSERT_EQ(queue->Signal(other_fence.Get(), 3), S_OK);
  ASSERT_EQ(fence->SetEventOnCompletion(3, nullptr), S_OK);
  EXPECT_EQ(fence->GetCompletedValue(), 3u);
  const UINT* texels = map(read.Get());
  EXPECT_THAT(std::vector<UINT>(texels, texels + kTexels), Each(99u));
  EXPECT_TRUE(messages().empty());
}

TEST_P(SharedResources, ACommittedResourceIsOpenedWithItsDesc) {
  const CD3DX12_HEAP_PROPERTIES properties(D3D12_HEAP_TYPE_DEFAULT);
  D3D12_RESOURCE_DESC desc = texture_desc(kSide, kSide, 1, DXGI_FORMAT_R32_UINT);
  desc.Flags = D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET;
  ComPtr<ID3D12Resource> texture;
  ASSERT_EQ(device_->CreateCommittedResource(&properties, D3D12_HEAP_FLAG_SHARED, &desc,
                                             D3D12_RESOURCE_STATE_RENDER_TARGET, nullptr,
                                             IID_PPV_ARGS(texture.GetAddressOf())),
            S_OK);
  const auto opened = open_on_other<ID3D12Resource>(texture.Get());
  EXPECT_EQ(opened->GetDesc().Width, kSide);
  EXPECT_EQ(opened->GetDesc().Format, DXGI_FORMAT_R32_UINT);
  // On the same device it is the same memory, too.
  HANDLE first = nullptr, second = nullptr;
  ASSERT_EQ(device_->CreateSharedHandle(texture.Get(), nullptr, GENERIC_ALL, L"frame", &first),
            S_OK);
  HANDLE by_name = nullptr;
  ASSERT_EQ(device_->OpenSharedHandleByName(L"frame", GENERIC_ALL, &by_name), S_OK);
  ComPtr<ID3D12Resource> again;
  ASSERT_EQ(device_->OpenSharedHandle(by_name, IID_PPV_ARGS(again.GetAddressOf())), S_OK);
  clear(texture.Get(), {17, 0, 0, 0});
  const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(
      again.Get(), D3D12_RESOURCE_STATE_COMMON, D3D12_RESOURCE_STATE_RENDER_TARGET);
  list_->ResourceBarrier(1, &barrier);
  EXPECT_THAT(words(again.Get(), kTexels), Each(17u));
  EXPECT_EQ(device_->CreateSharedHandle(texture.Get(), nullptr, GENERIC_ALL, L"frame", &second),
            DXGI_ERROR_NAME_ALREADY_EXISTS);
  EXPECT_TRUE(CloseHandle(by_name));
  EXPECT_TRUE(CloseHandle(first));
}

// [D3D12: D3D12_RESOURCE_FLAG_ALLOW_CROSS_ADAPTER]
TEST_P(SharedResources, TexturesForOtherAdaptersMayBeOfRows) {
  const CD3DX12_HEAP_PROPERTIES properties(D3D12_HEAP_TYPE_DEFAULT);
  const auto flags = D3D12_HEAP_FLAG_SHARED | D3D12_HEAP_FLAG_SHARED_CROSS_ADAPTER;
  D3D12_RESOURCE_DESC desc = texture_desc(kSide, kSide, 1, DXGI_FORMAT_R8G8B8A8_UNORM);
  desc.Layout = D3D12_TEXTURE_LAYOUT_ROW_MAJOR;
  ComPtr<ID3D12Resource> texture;
  const auto make = [&] {
    return device_->CreateCommittedResource(&properties, flags, &desc, D3D12_RESOURCE_STATE_COMMON,
                                            nullptr,
                                            IID_PPV_ARGS(texture.ReleaseAndGetAddressOf()));
  };
  EXPECT_EQ(make(), E_INVALIDARG) << "without the flag";
  desc.Flags = D3D12_RESOURCE_FLAG_ALLOW_CROSS_ADAPTER;
  ASSERT_EQ(make(), S_OK);
  EXPECT_EQ(texture->GetDesc().Layout, D3D12_TEXTURE_LAYOUT_ROW_MAJOR);
  EXPECT_NE(open_on_other<ID3D12Resource>(texture.Get()), nullptr);
  desc.MipLevels = 2;
  EXPECT_EQ(make(), E_INVALIDARG) << "with two mips";
}

TEST_P(SharedResources, OnlyWhatWasMadeToBeSharedIs) {
  HANDLE handle = nullptr;
  const auto alone = heap(D3D12_HEAP_TYPE_DEFAULT);
  EXPECT_EQ(device_->CreateSharedHandle(alone.Get(), nullptr, GENERIC_ALL, nullptr, &handle),
            E_INVALIDARG);
  EXPECT_EQ(device_->CreateSharedHandle(buffer(64, D3D12_HEAP_TYPE_DEFAULT).Get(), nullptr,
                                        GENERIC_ALL, nullptr, &handle),
            E_INVALIDARG);
  EXPECT_EQ(device_->CreateSharedHandle(queue_.Get(), nullptr, GENERIC_ALL, nullptr, &handle),
            E_INVALIDARG);
  EXPECT_EQ(handle, nullptr);
  ComPtr<ID3D12Heap> opened;
  EXPECT_EQ(device_->OpenSharedHandle(handle, IID_PPV_ARGS(opened.GetAddressOf())), E_INVALIDARG);
  EXPECT_EQ(device_->OpenSharedHandleByName(L"nothing", GENERIC_ALL, &handle), E_INVALIDARG);
  ASSERT_EQ(messages().size(), 5u);
  for (const std::string& message : messages()) EXPECT_NE(message.find("KA4027"), message.npos);
}

INSTANTIATE_TEST_SUITE_P(Backends, PlacedResources, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return std::string(backend.param); });
INSTANTIATE_TEST_SUITE_P(Backends, SharedResources, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return std::string(backend.param); });

}  // namespace
}  // namespace kaamos::d3d12
