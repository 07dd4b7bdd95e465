// SPDX-License-Identifier: MIT
// Which heaps and resources D3D12 has, and how much room they take. Each on every backend.
#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

class HeapRules : public D3d12BackendTest {
 protected:
  HRESULT make_heap(D3D12_HEAP_TYPE type, D3D12_CPU_PAGE_PROPERTY page, D3D12_MEMORY_POOL pool) {
    D3D12_HEAP_DESC desc = {};
    desc.SizeInBytes = 65536;
    desc.Properties = {type, page, pool, 1, 1};
    ComPtr<ID3D12Heap> heap;
    return device_->CreateHeap(&desc, IID_PPV_ARGS(heap.GetAddressOf()));
  }

  HRESULT make(D3D12_HEAP_TYPE type, const D3D12_RESOURCE_DESC& desc, D3D12_RESOURCE_STATES state,
               ComPtr<ID3D12Resource>* out = nullptr) {
    D3D12_HEAP_PROPERTIES heap = {};
    heap.Type = type;
    ComPtr<ID3D12Resource> resource;
    const HRESULT result = device_->CreateCommittedResource(
        &heap, D3D12_HEAP_FLAG_NONE, &desc, state, nullptr, IID_PPV_ARGS(resource.GetAddressOf()));
    if (out != nullptr) *out = resource;
    return result;
  }

  D3D12_RESOURCE_ALLOCATION_INFO info(const D3D12_RESOURCE_DESC& desc) {
    return device_->GetResourceAllocationInfo(0, 1, &desc);
  }
};

// [D3D12: D3D12_HEAP_PROPERTIES]
TEST_P(HeapRules, OnlyCustomHeapsChoosePagesAndPools) {
  const auto unknown = D3D12_MEMORY_POOL_UNKNOWN;
  for (const auto page :
       {D3D12_CPU_PAGE_PROPERTY_NOT_AVAILABLE, D3D12_CPU_PAGE_PROPERTY_WRITE_COMBINE,
        D3D12_CPU_PAGE_PROPERTY_WRITE_BACK}) {
    EXPECT_EQ(make_heap(D3D12_HEAP_TYPE_CUSTOM, page, D3D12_MEMORY_POOL_L0), S_OK) << page;
    EXPECT_EQ(make_heap(D3D12_HEAP_TYPE_CUSTOM, page, unknown), E_INVALIDARG) << page;
    EXPECT_EQ(make_heap(D3D12_HEAP_TYPE_CUSTOM, page, D3D12_MEMORY_POOL_L1),
              page == D3D12_CPU_PAGE_PROPERTY_NOT_AVAILABLE ? S_OK : E_INVALIDARG)
        << page;
    EXPECT_EQ(make_heap(D3D12_HEAP_TYPE_DEFAULT, page, unknown), E_INVALIDARG) << page;
  }
  EXPECT_EQ(
      make_heap(D3D12_HEAP_TYPE_UPLOAD, D3D12_CPU_PAGE_PROPERTY_UNKNOWN, D3D12_MEMORY_POOL_L0),
      E_INVALIDARG);
  EXPECT_EQ(make_heap(D3D12_HEAP_TYPE_UPLOAD, D3D12_CPU_PAGE_PROPERTY_UNKNOWN, unknown), S_OK);
}

// [D3D12: D3D12_HEAP_DESC]
TEST_P(HeapRules, HeapsHaveWholeMultiplesOfTheirAlignment) {
  D3D12_HEAP_DESC heap_desc = {};
  heap_desc.SizeInBytes = 65537;
  heap_desc.Properties.Type = D3D12_HEAP_TYPE_DEFAULT;
  ComPtr<ID3D12Heap> heap;
  ASSERT_EQ(device_->CreateHeap(&heap_desc, IID_PPV_ARGS(heap.GetAddressOf())), S_OK);
  const D3D12_RESOURCE_DESC desc = buffer(64, D3D12_HEAP_TYPE_DEFAULT)->GetDesc();
  const auto place = [&](UINT64 offset) {
    ComPtr<ID3D12Resource> placed;
    return device_->CreatePlacedResource(heap.Get(), offset, &desc, D3D12_RESOURCE_STATE_COMMON,
                                         nullptr, IID_PPV_ARGS(placed.GetAddressOf()));
  };
  EXPECT_EQ(place(65536), S_OK);
  EXPECT_EQ(place(131072), E_INVALIDARG);
}

// [D3D12: D3D12_RESOURCE_FLAGS; D3D12_HEAP_TYPE]
TEST_P(HeapRules, BuffersHaveNoFlagsOfTexturesNorOfWritesOnHeapsOfTheCpu) {
  D3D12_RESOURCE_DESC desc = buffer(64, D3D12_HEAP_TYPE_DEFAULT)->GetDesc();
  for (const auto flag :
       {D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL, D3D12_RESOURCE_FLAG_ALLOW_SIMULTANEOUS_ACCESS}) {
    desc.Flags = flag;
    EXPECT_EQ(make(D3D12_HEAP_TYPE_DEFAULT, desc, D3D12_RESOURCE_STATE_COMMON), E_INVALIDARG)
        << flag;
  }
  for (const auto flag :
       {D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET, D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS}) {
    desc.Flags = flag;
    EXPECT_EQ(make(D3D12_HEAP_TYPE_DEFAULT, desc, D3D12_RESOURCE_STATE_COMMON), S_OK) << flag;
    EXPECT_EQ(make(D3D12_HEAP_TYPE_UPLOAD, desc, D3D12_RESOURCE_STATE_GENERIC_READ), E_INVALIDARG)
        << flag;
    EXPECT_EQ(make(D3D12_HEAP_TYPE_READBACK, desc, D3D12_RESOURCE_STATE_COPY_DEST), E_INVALIDARG)
        << flag;
  }
}

// 16 tiles of 4 KiB, of 32 x 32 texels of 4 bytes, or 16 x 8 x 8. Mips and slices beside the first
// do not count. [D3D12: D3D12_RESOURCE_DESC, Alignment]
TEST_P(HeapRules, SmallAlignmentIsForFirstMipsOfSixteenTiles) {
  D3D12_RESOURCE_DESC desc = texture_desc(128, 128, 1, DXGI_FORMAT_R8G8B8A8_UNORM);
  desc.Alignment = D3D12_SMALL_RESOURCE_PLACEMENT_ALIGNMENT;
  desc.DepthOrArraySize = 7;
  desc.MipLevels = 3;
  EXPECT_EQ(info(desc).Alignment, 4096u);
  EXPECT_EQ(info(desc).SizeInBytes, 4096u * 147);  // 7 x (64 + 16 + 4) KiB
  ComPtr<ID3D12Resource> small;
  EXPECT_EQ(make(D3D12_HEAP_TYPE_DEFAULT, desc, D3D12_RESOURCE_STATE_COMMON, &small), S_OK);
  ASSERT_NE(small, nullptr);
  EXPECT_EQ(small->GetDesc().Alignment, 4096u);
  desc.Width = 129;
  EXPECT_EQ(info(desc).SizeInBytes, UINT64_MAX);
  EXPECT_EQ(make(D3D12_HEAP_TYPE_DEFAULT, desc, D3D12_RESOURCE_STATE_COMMON), E_INVALIDARG);
  desc = texture_desc(32, 32, 16, DXGI_FORMAT_R8G8B8A8_UNORM);
  desc.Alignment = D3D12_SMALL_RESOURCE_PLACEMENT_ALIGNMENT;
  EXPECT_EQ(info(desc).Alignment, 4096u);
  desc.DepthOrArraySize = 17;
  EXPECT_EQ(info(desc).SizeInBytes, UINT64_MAX);
}

TEST_P(HeapRules, MultisampledTargetsTellTheirAlignment) {
  D3D12_RESOURCE_DESC desc = texture_desc(16, 16, 1, DXGI_FORMAT_R8G8B8A8_UNORM);
  desc.SampleDesc.Count = 4;
  desc.Flags = D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET;
  ComPtr<ID3D12Resource> target;
  ASSERT_EQ(make(D3D12_HEAP_TYPE_DEFAULT, desc, D3D12_RESOURCE_STATE_COMMON, &target), S_OK);
  EXPECT_EQ(target->GetDesc().Alignment, 4194304u);
  desc.Alignment = 65536;
  ASSERT_EQ(make(D3D12_HEAP_TYPE_DEFAULT, desc, D3D12_RESOURCE_STATE_COMMON, &target), S_OK);
  EXPECT_EQ(target->GetDesc().Alignment, 65536u);
}

// [D3D12: GetCopyableFootprints]
TEST_P(HeapRules, FootprintsAreOfOneSampleAndOfDescriptionsThatExist) {
  D3D12_RESOURCE_DESC desc = texture_desc(16, 16, 1, DXGI_FORMAT_R8G8B8A8_UNORM);
  desc.SampleDesc.Count = 4;
  desc.Flags = D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET;
  D3D12_PLACED_SUBRESOURCE_FOOTPRINT layout;
  UINT64 total = 0;
  device_->GetCopyableFootprints(&desc, 0, 1, 0, &layout, nullptr, nullptr, &total);
  EXPECT_EQ(layout.Footprint.RowPitch, 256u);
  EXPECT_EQ(total, 15 * 256 + 64u);
  desc = buffer(64, D3D12_HEAP_TYPE_DEFAULT)->GetDesc();
  desc.Height = 2;
  device_->GetCopyableFootprints(&desc, 0, 1, 0, &layout, nullptr, nullptr, &total);
  EXPECT_EQ(layout.Footprint.RowPitch, UINT_MAX);
  EXPECT_EQ(total, UINT64_MAX);
}

TEST_P(HeapRules, ThereAreNoMetaCommands) {
  ComPtr<ID3D12Device5> device;
  ASSERT_EQ(device_.As(&device), S_OK);
  UINT count = 7;
  EXPECT_EQ(device->EnumerateMetaCommands(&count, nullptr), S_OK);
  EXPECT_EQ(count, 0u);
  EXPECT_EQ(device->EnumerateMetaCommands(nullptr, nullptr), E_INVALIDARG);
}

INSTANTIATE_TEST_SUITE_P(Backends, HeapRules, testing::Values("embree", "vulkan"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace kaamos::d3d12
