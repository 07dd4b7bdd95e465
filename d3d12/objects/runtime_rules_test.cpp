// SPDX-License-Identifier: MIT
// What D3D12's runtimes do beside the rules that programs obey: calls that they drop, descriptions
// that they complete, codes of what they refuse. Each on every backend.
#include <cstdlib>
#include <cstring>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

class RuntimeRules : public D3d12BackendTest {
 protected:
  std::vector<uint32_t> read(ID3D12Resource* source, size_t count) {
    const auto readback =
        buffer(count * 4, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
    list_->CopyBufferRegion(readback.Get(), 0, source, 0, count * 4);
    run();
    void* bytes = nullptr;
    EXPECT_EQ(readback->Map(0, nullptr, &bytes), S_OK);
    std::vector<uint32_t> out(count);
    std::memcpy(out.data(), bytes, count * 4);
    return out;
  }
};

TEST_P(RuntimeRules, DroppedCallsLeaveTheRestOfTheList) {
  const auto words = buffer(16, D3D12_HEAP_TYPE_DEFAULT);
  const auto upload = buffer(16, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  list_->DrawInstanced(3, 1, 0, 0);  // without a pipeline
  list_->Dispatch(1, 1, 1);
  D3D12_RESOURCE_BARRIER barrier = {};
  barrier.Transition = {upload.Get(), D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES,
                        D3D12_RESOURCE_STATE_GENERIC_READ, D3D12_RESOURCE_STATE_COPY_SOURCE};
  list_->ResourceBarrier(1, &barrier);
  const D3D12_VERTEX_BUFFER_VIEW past = {upload->GetGPUVirtualAddress(), 4096, 16};
  list_->IASetVertexBuffers(0, 1, &past);
  EXPECT_EQ(messages().size(), 4u);
  ComPtr<ID3D12GraphicsCommandList2> list2;
  ASSERT_EQ(list_.As(&list2), S_OK);
  const D3D12_WRITEBUFFERIMMEDIATE_PARAMETER values[] = {{words->GetGPUVirtualAddress() + 4, 5},
                                                         {words->GetGPUVirtualAddress() + 12, 6}};
  list2->WriteBufferImmediate(2, values, nullptr);
  EXPECT_EQ(read(words.Get(), 4), (std::vector<uint32_t>{0, 5, 0, 6}));
}

TEST_P(RuntimeRules, UnknownModesOfImmediateValuesFailTheList) {
  const auto words = buffer(16, D3D12_HEAP_TYPE_DEFAULT);
  ComPtr<ID3D12GraphicsCommandList2> list2;
  ASSERT_EQ(list_.As(&list2), S_OK);
  const D3D12_WRITEBUFFERIMMEDIATE_PARAMETER value = {words->GetGPUVirtualAddress(), 5};
  const auto mode = static_cast<D3D12_WRITEBUFFERIMMEDIATE_MODE>(99);
  list2->WriteBufferImmediate(1, &value, &mode);
  EXPECT_EQ(list_->Close(), E_INVALIDARG);
}

TEST_P(RuntimeRules, TexelsOfCustomHeapsAreReadAndWritten) {
  D3D12_HEAP_PROPERTIES heap = {D3D12_HEAP_TYPE_CUSTOM, D3D12_CPU_PAGE_PROPERTY_WRITE_BACK,
                                D3D12_MEMORY_POOL_L0, 0, 0};
  const D3D12_RESOURCE_DESC desc = texture_desc(6, 5, 3, DXGI_FORMAT_R32_UINT);
  ComPtr<ID3D12Resource> texture;
  ASSERT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                             D3D12_RESOURCE_STATE_COMMON, nullptr,
                                             IID_PPV_ARGS(texture.GetAddressOf())),
            S_OK);
  EXPECT_EQ(texture->Map(0, nullptr, nullptr), S_OK);
  void* untouched = &heap;
  EXPECT_EQ(texture->Map(0, nullptr, &untouched), E_INVALIDARG);
  EXPECT_EQ(untouched, &heap);
  const uint32_t source[2][2][3] = {{{1, 2, 99}, {3, 4, 99}}, {{5, 6, 99}, {7, 8, 99}}};
  const D3D12_BOX box = {2, 1, 1, 4, 3, 3};
  EXPECT_EQ(texture->WriteToSubresource(0, &box, source, 12, 24), S_OK);
  uint32_t all[3][5][6] = {};
  EXPECT_EQ(texture->ReadFromSubresource(all, 24, 120, 0, nullptr), S_OK);
  for (uint32_t z = 0; z < 3; ++z) {
    for (uint32_t y = 0; y < 5; ++y) {
      for (uint32_t x = 0; x < 6; ++x) {
        const bool inside = x >= 2 && x < 4 && y >= 1 && y < 3 && z >= 1;
        EXPECT_EQ(all[z][y][x], inside ? source[z - 1][y - 1][x - 2] : 0) << x << y << z;
      }
    }
  }
  const D3D12_BOX empty = {6, 5, 3, 6, 5, 3}, flat = {2, 1, 1, 2, 3, 3},
                  outside = {0, 0, 0, 7, 1, 1};
  EXPECT_EQ(texture->ReadFromSubresource(all, 24, 120, 0, &empty), S_OK);
  EXPECT_EQ(texture->ReadFromSubresource(all, 24, 120, 0, &flat), E_INVALIDARG);
  EXPECT_EQ(texture->ReadFromSubresource(all, 24, 120, 0, &outside), E_INVALIDARG);
  EXPECT_EQ(texture->ReadFromSubresource(all, 24, 120, 1, nullptr), E_INVALIDARG);
  const auto readback = buffer(64, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  EXPECT_EQ(readback->WriteToSubresource(0, nullptr, source, 12, 24), E_INVALIDARG);
}

TEST_P(RuntimeRules, DescriptionsComeBackComplete) {
  D3D12_HEAP_DESC heap_desc = {};
  heap_desc.SizeInBytes = 65536;
  heap_desc.Properties.Type = D3D12_HEAP_TYPE_DEFAULT;
  heap_desc.Flags = D3D12_HEAP_FLAG_ALLOW_ONLY_BUFFERS;
  ComPtr<ID3D12Heap> heap;
  ASSERT_EQ(device_->CreateHeap(&heap_desc, IID_PPV_ARGS(heap.GetAddressOf())), S_OK);
  EXPECT_EQ(heap->GetDesc().Alignment, 65536u);
  EXPECT_EQ(heap->GetDesc().Properties.CreationNodeMask, 1u);
  EXPECT_EQ(heap->GetDesc().Properties.VisibleNodeMask, 1u);
  EXPECT_EQ(queue_->GetDesc().NodeMask, 1u);
  const auto words = buffer(16, D3D12_HEAP_TYPE_DEFAULT);
  EXPECT_EQ(words->GetDesc().Alignment, 65536u);
  D3D12_HEAP_PROPERTIES properties = {};
  ASSERT_EQ(words->GetHeapProperties(&properties, nullptr), S_OK);
  EXPECT_EQ(properties.CreationNodeMask, 1u);
  // A heap of buffers holds no textures, and buffers have no clear value.
  ComPtr<ID3D12Resource> placed;
  D3D12_RESOURCE_DESC desc = texture_desc(4, 4, 1, DXGI_FORMAT_R8G8B8A8_UNORM);
  EXPECT_EQ(device_->CreatePlacedResource(heap.Get(), 0, &desc, D3D12_RESOURCE_STATE_COMMON,
                                          nullptr, IID_PPV_ARGS(placed.GetAddressOf())),
            E_INVALIDARG);
  desc = words->GetDesc();
  D3D12_CLEAR_VALUE clear = {};
  EXPECT_EQ(device_->CreatePlacedResource(heap.Get(), 0, &desc, D3D12_RESOURCE_STATE_COMMON, &clear,
                                          IID_PPV_ARGS(placed.GetAddressOf())),
            E_INVALIDARG);
  heap_desc.Flags = D3D12_HEAP_FLAG_ALLOW_DISPLAY;
  EXPECT_EQ(device_->CreateHeap(&heap_desc, IID_PPV_ARGS(heap.ReleaseAndGetAddressOf())),
            E_INVALIDARG);
}

TEST_P(RuntimeRules, WhatTheLibraryHoldsIsNoReference) {
  const auto count = [](IUnknown* object) {
    object->AddRef();
    return object->Release();
  };
  EXPECT_EQ(count(allocator_.Get()), 1u);  // of a list that records
  D3D12_HEAP_DESC heap_desc = {};
  heap_desc.SizeInBytes = 65536;
  heap_desc.Properties.Type = D3D12_HEAP_TYPE_DEFAULT;
  ComPtr<ID3D12Heap> heap;
  ASSERT_EQ(device_->CreateHeap(&heap_desc, IID_PPV_ARGS(heap.GetAddressOf())), S_OK);
  const D3D12_RESOURCE_DESC desc = buffer(16, D3D12_HEAP_TYPE_DEFAULT)->GetDesc();
  ComPtr<ID3D12Resource> placed;
  ASSERT_EQ(device_->CreatePlacedResource(heap.Get(), 0, &desc, D3D12_RESOURCE_STATE_COMMON,
                                          nullptr, IID_PPV_ARGS(placed.GetAddressOf())),
            S_OK);
  EXPECT_EQ(count(heap.Get()), 1u);
  EXPECT_EQ(heap.Reset(), 0u);  // the resource keeps the heap
  EXPECT_EQ(placed.Reset(), 0u);
}

TEST_P(RuntimeRules, AllocationInfoFollowsTheAlignmentAskedFor) {
  D3D12_RESOURCE_DESC desc = texture_desc(16, 16, 1, DXGI_FORMAT_R8G8B8A8_UNORM);
  EXPECT_EQ(device_->GetResourceAllocationInfo(0, 0, nullptr).SizeInBytes, 0u);
  EXPECT_EQ(device_->GetResourceAllocationInfo(0, 0, nullptr).Alignment, 1u);
  EXPECT_EQ(device_->GetResourceAllocationInfo(0, 1, &desc).Alignment, 65536u);
  desc.Alignment = D3D12_SMALL_RESOURCE_PLACEMENT_ALIGNMENT;
  EXPECT_EQ(device_->GetResourceAllocationInfo(0, 1, &desc).Alignment, 4096u);
  D3D12_RESOURCE_DESC target = desc;
  target.Flags = D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET;
  D3D12_RESOURCE_ALLOCATION_INFO refused = device_->GetResourceAllocationInfo(0, 1, &target);
  EXPECT_EQ(refused.SizeInBytes, UINT64_MAX);
  EXPECT_EQ(refused.Alignment, 65536u);
  target.Alignment = 0;
  const D3D12_RESOURCE_DESC two[] = {desc, target};
  D3D12_RESOURCE_ALLOCATION_INFO1 infos[2] = {};
  const auto all = device_->GetResourceAllocationInfo1(0, 2, two, infos);
  EXPECT_EQ(infos[0].SizeInBytes, 4096u);
  EXPECT_EQ(infos[1].Offset, 65536u);
  EXPECT_EQ(all.SizeInBytes, 2 * 65536u);
  EXPECT_EQ(all.Alignment, 65536u);
}

TEST_P(RuntimeRules, ResourcesStartInABarrierLayout) {
  ComPtr<ID3D12Device10> device;
  ASSERT_EQ(device_.As(&device), S_OK);
  D3D12_HEAP_PROPERTIES heap = {};
  heap.Type = D3D12_HEAP_TYPE_DEFAULT;
  const D3D12_RESOURCE_DESC plain = texture_desc(4, 4, 1, DXGI_FORMAT_R32_UINT);
  D3D12_RESOURCE_DESC1 desc = {};
  std::memcpy(&desc, &plain, sizeof(plain));
  ComPtr<ID3D12Resource> texture;
  ASSERT_EQ(device->CreateCommittedResource3(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                             D3D12_BARRIER_LAYOUT_COPY_SOURCE, nullptr, nullptr, 0,
                                             nullptr, IID_PPV_ARGS(texture.GetAddressOf())),
            S_OK);
  D3D12_RESOURCE_ALLOCATION_INFO1 info = {};
  EXPECT_EQ(device->GetResourceAllocationInfo2(0, 1, &desc, &info).SizeInBytes, 65536u);
  ComPtr<ID3D12Device14> newest;
  ASSERT_EQ(device_.As(&newest), S_OK);
  const UINT32 formats = 1;
  const DXGI_FORMAT castable = DXGI_FORMAT_R32_FLOAT;
  const DXGI_FORMAT* const castables[] = {&castable};
  EXPECT_EQ(newest->GetResourceAllocationInfo3(0, 1, &desc, &formats, castables, &info).SizeInBytes,
            65536u);
  D3D12_HEAP_DESC heap_desc = {};
  heap_desc.SizeInBytes = 65536;
  heap_desc.Properties = heap;
  ComPtr<ID3D12Heap> memory;
  ASSERT_EQ(device_->CreateHeap(&heap_desc, IID_PPV_ARGS(memory.GetAddressOf())), S_OK);
  ComPtr<ID3D12Resource> placed;
  ASSERT_EQ(device->CreatePlacedResource2(memory.Get(), 0, &desc, D3D12_BARRIER_LAYOUT_COPY_DEST,
                                          nullptr, 0, nullptr, IID_PPV_ARGS(placed.GetAddressOf())),
            S_OK);
  list_->CopyResource(placed.Get(), texture.Get());
  run();
  EXPECT_TRUE(messages().empty());
}

TEST_P(RuntimeRules, EveryFormatHasItsPlanes) {
  const auto planes = [&](UINT format) {
    D3D12_FEATURE_DATA_FORMAT_INFO info = {static_cast<DXGI_FORMAT>(format), 77};
    const HRESULT result =
        device_->CheckFeatureSupport(D3D12_FEATURE_FORMAT_INFO, &info, sizeof(info));
    return SUCCEEDED(result) ? int{info.PlaneCount} : -1;
  };
  EXPECT_EQ(planes(DXGI_FORMAT_UNKNOWN), 1);
  EXPECT_EQ(planes(DXGI_FORMAT_R24G8_TYPELESS), 2);
  EXPECT_EQ(planes(DXGI_FORMAT_X32_TYPELESS_G8X24_UINT), 2);
  EXPECT_EQ(planes(DXGI_FORMAT_D16_UNORM), 1);
  EXPECT_EQ(planes(DXGI_FORMAT_NV12), 2);
  EXPECT_EQ(planes(DXGI_FORMAT_R1_UNORM), -1);
  EXPECT_EQ(planes(5000), -1);
  D3D12_FEATURE_DATA_MULTISAMPLE_QUALITY_LEVELS levels = {DXGI_FORMAT_R8G8B8A8_UNORM, 0, {}, 9};
  EXPECT_EQ(device_->CheckFeatureSupport(D3D12_FEATURE_MULTISAMPLE_QUALITY_LEVELS, &levels,
                                         sizeof(levels)),
            E_FAIL);
  EXPECT_EQ(levels.NumQualityLevels, 0u);
}

TEST_P(RuntimeRules, OnlyFeatureLevelsThatExistAreAskedFor) {
  ComPtr<ID3D12Device> device;
  for (const UINT level : {0x9100u, 0xA000u, 0u, ~0u}) {
    EXPECT_EQ(D3D12CreateDevice(nullptr, static_cast<D3D_FEATURE_LEVEL>(level),
                                IID_PPV_ARGS(device.GetAddressOf())),
              E_INVALIDARG)
        << level;
  }
  ComPtr<ID3D12CommandAllocator> allocator;
  EXPECT_EQ(device_->CreateCommandAllocator(static_cast<D3D12_COMMAND_LIST_TYPE>(~0u),
                                            IID_PPV_ARGS(allocator.GetAddressOf())),
            E_INVALIDARG);
}

// Each channel takes the low bits of its value, those of NaNs too.
// [D3D12: ClearUnorderedAccessViewUint]
TEST_P(RuntimeRules, PackedFloatsAreClearedToTheirBits) {
  const auto target = buffer(16, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                             D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  D3D12_DESCRIPTOR_HEAP_DESC heap_desc = {};
  heap_desc.Type = D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV;
  heap_desc.NumDescriptors = 1;
  ComPtr<ID3D12DescriptorHeap> host, visible;
  ASSERT_EQ(device_->CreateDescriptorHeap(&heap_desc, IID_PPV_ARGS(host.GetAddressOf())), S_OK);
  heap_desc.Flags = D3D12_DESCRIPTOR_HEAP_FLAG_SHADER_VISIBLE;
  ASSERT_EQ(device_->CreateDescriptorHeap(&heap_desc, IID_PPV_ARGS(visible.GetAddressOf())), S_OK);
  D3D12_UNORDERED_ACCESS_VIEW_DESC view = {};
  view.ViewDimension = D3D12_UAV_DIMENSION_BUFFER;
  view.Format = DXGI_FORMAT_R11G11B10_FLOAT;
  view.Buffer.FirstElement = 1;
  view.Buffer.NumElements = 2;
  for (ID3D12DescriptorHeap* heap : {host.Get(), visible.Get()}) {
    device_->CreateUnorderedAccessView(target.Get(), nullptr, &view,
                                       heap->GetCPUDescriptorHandleForHeapStart());
  }
  ID3D12DescriptorHeap* heaps[] = {visible.Get()};
  list_->SetDescriptorHeaps(1, heaps);
  const UINT bits[4] = {0x7FF, 0x801, 0x3E5, 9};
  list_->ClearUnorderedAccessViewUint(visible->GetGPUDescriptorHandleForHeapStart(),
                                      host->GetCPUDescriptorHandleForHeapStart(), target.Get(),
                                      bits, 0, nullptr);
  D3D12_RESOURCE_BARRIER barrier = {};
  barrier.Transition = {target.Get(), 0, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                        D3D12_RESOURCE_STATE_COPY_SOURCE};
  list_->ResourceBarrier(1, &barrier);
  const uint32_t packed = 0x7FF | 1 << 11 | 0x3E5u << 22;
  EXPECT_EQ(read(target.Get(), 4), (std::vector<uint32_t>{0, packed, packed, 0}));
}

INSTANTIATE_TEST_SUITE_P(Backends, RuntimeRules, testing::Values("embree", "vulkan"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace kaamos::d3d12
