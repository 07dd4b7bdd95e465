// SPDX-License-Identifier: MIT
// Command lists and allocators: life, copies, queries, errors.
#include <cstring>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

class CommandListCalls : public D3d12Test {
 protected:
  // The first words of a buffer that the host cannot map.
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
  ComPtr<ID3D12Resource> uploaded(const std::vector<uint32_t>& words) {
    const auto out =
        buffer(words.size() * 4, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
    void* bytes = nullptr;
    EXPECT_EQ(out->Map(0, nullptr, &bytes), S_OK);
    std::memcpy(bytes, words.data(), words.size() * 4);
    return out;
  }
};

TEST_F(CommandListCalls, BytesGoFromUploadToReadback) {
  const auto upload = buffer(16, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  void* bytes = nullptr;
  ASSERT_EQ(upload->Map(0, nullptr, &bytes), S_OK);
  const uint32_t values[4] = {1, 2, 3, 4};
  std::memcpy(bytes, values, sizeof(values));
  const auto middle = buffer(16, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_COPY_DEST);
  list_->CopyResource(middle.Get(), upload.Get());
  D3D12_RESOURCE_BARRIER barrier = {};
  barrier.Type = D3D12_RESOURCE_BARRIER_TYPE_TRANSITION;
  barrier.Transition = {middle.Get(), D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES,
                        D3D12_RESOURCE_STATE_COPY_DEST, D3D12_RESOURCE_STATE_COPY_SOURCE};
  list_->ResourceBarrier(1, &barrier);
  EXPECT_EQ(read(middle.Get(), 4), (std::vector<uint32_t>{1, 2, 3, 4}));
}

TEST_F(CommandListCalls, AViewIsCleared) {
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
  view.Format = DXGI_FORMAT_R32_TYPELESS;
  view.Buffer.NumElements = 4;
  view.Buffer.Flags = D3D12_BUFFER_UAV_FLAG_RAW;
  for (ID3D12DescriptorHeap* heap : {host.Get(), visible.Get()}) {
    device_->CreateUnorderedAccessView(target.Get(), nullptr, &view,
                                       heap->GetCPUDescriptorHandleForHeapStart());
  }
  ID3D12DescriptorHeap* heaps[] = {visible.Get()};
  list_->SetDescriptorHeaps(1, heaps);
  const UINT seven[4] = {7, 7, 7, 7};
  list_->ClearUnorderedAccessViewUint(visible->GetGPUDescriptorHandleForHeapStart(),
                                      host->GetCPUDescriptorHandleForHeapStart(), target.Get(),
                                      seven, 0, nullptr);
  EXPECT_EQ(read(target.Get(), 4), (std::vector<uint32_t>{7, 7, 7, 7}));
  EXPECT_TRUE(messages().empty());
}

TEST_F(CommandListCalls, TimestampsGrow) {
  D3D12_QUERY_HEAP_DESC desc = {D3D12_QUERY_HEAP_TYPE_TIMESTAMP, 2, 0};
  ComPtr<ID3D12QueryHeap> heap;
  ASSERT_EQ(device_->CreateQueryHeap(&desc, IID_PPV_ARGS(heap.GetAddressOf())), S_OK);
  const auto readback = buffer(16, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  list_->EndQuery(heap.Get(), D3D12_QUERY_TYPE_TIMESTAMP, 0);
  list_->EndQuery(heap.Get(), D3D12_QUERY_TYPE_TIMESTAMP, 1);
  list_->ResolveQueryData(heap.Get(), D3D12_QUERY_TYPE_TIMESTAMP, 0, 2, readback.Get(), 0);
  run();
  void* bytes = nullptr;
  ASSERT_EQ(readback->Map(0, nullptr, &bytes), S_OK);
  const auto* ticks = static_cast<const UINT64*>(bytes);
  EXPECT_LE(ticks[0], ticks[1]);
  UINT64 frequency = 0, gpu = 0, cpu = 0;
  EXPECT_EQ(queue_->GetTimestampFrequency(&frequency), S_OK);
  EXPECT_GT(frequency, 0u);
  EXPECT_EQ(queue_->GetClockCalibration(&gpu, &cpu), S_OK);
  EXPECT_GE(gpu, ticks[1]);
}

// A query of nothing is 0, and leaves out a copy.
TEST_F(CommandListCalls, QueriesDecideOverCopies) {
  D3D12_QUERY_HEAP_DESC desc = {D3D12_QUERY_HEAP_TYPE_OCCLUSION, 2, 0};
  ComPtr<ID3D12QueryHeap> heap;
  ASSERT_EQ(device_->CreateQueryHeap(&desc, IID_PPV_ARGS(heap.GetAddressOf())), S_OK);
  const auto predicate = buffer(16, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_COPY_DEST);
  const auto target = buffer(16, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_COPY_DEST);
  const auto source = uploaded({1, 2, 3, 4});
  list_->BeginQuery(heap.Get(), D3D12_QUERY_TYPE_BINARY_OCCLUSION, 1);
  list_->EndQuery(heap.Get(), D3D12_QUERY_TYPE_BINARY_OCCLUSION, 1);
  list_->ResolveQueryData(heap.Get(), D3D12_QUERY_TYPE_BINARY_OCCLUSION, 1, 1, predicate.Get(), 8);
  list_->SetPredication(predicate.Get(), 8, D3D12_PREDICATION_OP_EQUAL_ZERO);
  list_->CopyBufferRegion(target.Get(), 0, source.Get(), 0, 4);
  list_->SetPredication(predicate.Get(), 8, D3D12_PREDICATION_OP_NOT_EQUAL_ZERO);
  list_->CopyBufferRegion(target.Get(), 4, source.Get(), 4, 4);
  list_->SetPredication(nullptr, 0, D3D12_PREDICATION_OP_EQUAL_ZERO);
  list_->CopyBufferRegion(target.Get(), 8, source.Get(), 8, 4);
  EXPECT_EQ(read(target.Get(), 4), (std::vector<uint32_t>{0, 2, 3, 0}));
}

TEST_F(CommandListCalls, CloseReportsEveryErrorAndReturnsTheFirst) {
  const auto small = buffer(16, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  const auto upload = buffer(16, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  list_->CopyBufferRegion(small.Get(), 8, upload.Get(), 0, 16);
  list_->CopyBufferRegion(small.Get(), 16, upload.Get(), 0, 16);
  EXPECT_TRUE(messages().empty());
  EXPECT_EQ(list_->Close(), E_INVALIDARG);
  ASSERT_EQ(messages().size(), 2u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA0817");
  EXPECT_EQ(list_->Close(), E_FAIL);
}

TEST_F(CommandListCalls, AnAllocatorServesOneListAtATime) {
  ComPtr<ID3D12GraphicsCommandList> second;
  EXPECT_EQ(device_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_DIRECT, allocator_.Get(), nullptr,
                                       IID_PPV_ARGS(second.GetAddressOf())),
            E_INVALIDARG);
  EXPECT_EQ(allocator_->Reset(), E_FAIL);
  ASSERT_EQ(list_->Close(), S_OK);
  EXPECT_EQ(allocator_->Reset(), S_OK);
  ASSERT_EQ(device_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_DIRECT, allocator_.Get(), nullptr,
                                       IID_PPV_ARGS(second.GetAddressOf())),
            S_OK);
  EXPECT_EQ(list_->Reset(allocator_.Get(), nullptr), E_INVALIDARG);
  EXPECT_EQ(device_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_COPY, allocator_.Get(), nullptr,
                                       IID_PPV_ARGS(second.ReleaseAndGetAddressOf())),
            E_INVALIDARG);
}

TEST_F(CommandListCalls, ASplitBarrierTakesPlaceAtItsEnd) {
  const auto data = buffer(16, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_COPY_DEST);
  D3D12_RESOURCE_BARRIER barrier = {};
  barrier.Type = D3D12_RESOURCE_BARRIER_TYPE_TRANSITION;
  barrier.Flags = D3D12_RESOURCE_BARRIER_FLAG_BEGIN_ONLY;
  barrier.Transition = {data.Get(), D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES,
                        D3D12_RESOURCE_STATE_COPY_DEST, D3D12_RESOURCE_STATE_COPY_SOURCE};
  list_->ResourceBarrier(1, &barrier);
  barrier.Flags = D3D12_RESOURCE_BARRIER_FLAG_END_ONLY;
  list_->ResourceBarrier(1, &barrier);
  barrier.Type = D3D12_RESOURCE_BARRIER_TYPE_ALIASING;
  barrier.Aliasing = {nullptr, data.Get()};
  list_->ResourceBarrier(1, &barrier);
  EXPECT_EQ(read(data.Get(), 1), std::vector<uint32_t>{0});
  EXPECT_TRUE(messages().empty());
}

TEST_F(CommandListCalls, EnhancedBarriersOfEachType) {
  D3D12_FEATURE_DATA_D3D12_OPTIONS12 options = {};
  ASSERT_EQ(device_->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS12, &options, sizeof(options)),
            S_OK);
  EXPECT_TRUE(options.EnhancedBarriersSupported);
  const auto data = buffer(16, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_COMMON);
  ComPtr<ID3D12GraphicsCommandList7> list;
  ASSERT_EQ(list_.As(&list), S_OK);
  D3D12_GLOBAL_BARRIER all = {D3D12_BARRIER_SYNC_ALL, D3D12_BARRIER_SYNC_ALL,
                              D3D12_BARRIER_ACCESS_COMMON, D3D12_BARRIER_ACCESS_COMMON};
  D3D12_BUFFER_BARRIER one = {D3D12_BARRIER_SYNC_NONE,
                              D3D12_BARRIER_SYNC_COPY,
                              D3D12_BARRIER_ACCESS_NO_ACCESS,
                              D3D12_BARRIER_ACCESS_COPY_SOURCE,
                              data.Get(),
                              0,
                              UINT64_MAX};
  D3D12_BARRIER_GROUP groups[2] = {};
  groups[0].Type = D3D12_BARRIER_TYPE_GLOBAL;
  groups[0].NumBarriers = 1;
  groups[0].pGlobalBarriers = &all;
  groups[1].Type = D3D12_BARRIER_TYPE_BUFFER;
  groups[1].NumBarriers = 1;
  groups[1].pBufferBarriers = &one;
  list->Barrier(2, groups);
  EXPECT_EQ(read(data.Get(), 1), std::vector<uint32_t>{0});
  EXPECT_TRUE(messages().empty());
  one.Size = 8;
  list->Barrier(1, &groups[1]);
  list->Barrier(1, nullptr);
  groups[0].Type = static_cast<D3D12_BARRIER_TYPE>(3);
  list->Barrier(1, groups);
  EXPECT_EQ(list_->Close(), E_INVALIDARG);
  ASSERT_EQ(messages().size(), 3u);
}

TEST_F(CommandListCalls, WhatIsMissingSaysSo) {
  list_->SOSetTargets(0, 0, nullptr);
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA4000");
  EXPECT_NE(messages()[0].find("ID3D12GraphicsCommandList::SOSetTargets"), std::string::npos);
}

TEST_F(CommandListCalls, ABarrierBetweenEqualStatesDoesNothing) {
  const auto target = buffer(16, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_COPY_DEST);
  D3D12_RESOURCE_BARRIER barrier = {};
  barrier.Transition = {target.Get(), D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES,
                        D3D12_RESOURCE_STATE_COPY_DEST, D3D12_RESOURCE_STATE_COPY_DEST};
  list_->ResourceBarrier(1, &barrier);
  EXPECT_EQ(list_->Close(), S_OK);
  EXPECT_TRUE(messages().empty());
}

TEST_F(CommandListCalls, EventsNeedNotBalance) {
  list_->EndEvent();
  const char name[] = "pass";
  list_->BeginEvent(1, name, sizeof(name));
  list_->BeginEvent(0, L"inner", sizeof(L"inner"));
  list_->EndEvent();
  run();
  EXPECT_TRUE(messages().empty());
}

TEST_F(CommandListCalls, CloseTellsWhatTheFacadeRefused) {
  list_->DispatchRays(nullptr);
  list_->ResourceBarrier(1, nullptr);
  list_->SetDescriptorHeaps(1, nullptr);
  EXPECT_EQ(messages().size(), 3u);
  EXPECT_EQ(list_->Close(), E_INVALIDARG);
  ASSERT_EQ(allocator_->Reset(), S_OK);
  ASSERT_EQ(list_->Reset(allocator_.Get(), nullptr), S_OK);
  EXPECT_EQ(list_->Close(), S_OK);
}

}  // namespace
}  // namespace kaamos::d3d12
