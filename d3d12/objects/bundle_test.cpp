// SPDX-License-Identifier: MIT
// Bundles: what they keep, how often they run, and what is refused.
#include <cstring>
#include <string>

#include <d3dcompiler.h>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

class BundleCalls : public D3d12Test {
 protected:
  void SetUp() override {
    D3d12Test::SetUp();
    ASSERT_EQ(device_->CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE_BUNDLE,
                                              IID_PPV_ARGS(bundle_allocator_.GetAddressOf())),
              S_OK);
  }

  // Adds a root constant to a word of a buffer.
  ComPtr<ID3D12PipelineState> adder() {
    const std::string text =
        "cbuffer Step : register(b0) { uint step; };"
        "RWByteAddressBuffer sum : register(u0);"
        "[RootSignature(\"RootConstants(num32BitConstants = 1, b0), UAV(u0)\")]"
        "[numthreads(1, 1, 1)] void main() { sum.Store(0, sum.Load(0) + step); }";
    ComPtr<ID3DBlob> code;
    EXPECT_EQ(D3DCompile(text.data(), text.size(), "add.hlsl", nullptr, nullptr, "main", "cs_6_0",
                         0, 0, code.GetAddressOf(), nullptr),
              S_OK);
    EXPECT_EQ(device_->CreateRootSignature(0, code->GetBufferPointer(), code->GetBufferSize(),
                                           IID_PPV_ARGS(root_signature_.GetAddressOf())),
              S_OK);
    D3D12_COMPUTE_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = root_signature_.Get();
    desc.CS = {code->GetBufferPointer(), code->GetBufferSize()};
    ComPtr<ID3D12PipelineState> out;
    EXPECT_EQ(device_->CreateComputePipelineState(&desc, IID_PPV_ARGS(out.GetAddressOf())), S_OK);
    return out;
  }

  HRESULT create_bundle(ID3D12PipelineState* state, ComPtr<ID3D12GraphicsCommandList4>& bundle) {
    return device_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_BUNDLE, bundle_allocator_.Get(),
                                      state, IID_PPV_ARGS(bundle.ReleaseAndGetAddressOf()));
  }

  ComPtr<ID3D12CommandAllocator> bundle_allocator_;
  ComPtr<ID3D12RootSignature> root_signature_;
};

TEST_F(BundleCalls, RunWhereTheyAreExecutedWithWhatTheyKept) {
  const auto pipeline = adder();
  const auto sum = buffer(4, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                          D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  ComPtr<ID3D12GraphicsCommandList4> bundle;
  ASSERT_EQ(create_bundle(pipeline.Get(), bundle), S_OK);
  EXPECT_EQ(bundle->GetType(), D3D12_COMMAND_LIST_TYPE_BUNDLE);
  uint32_t step = 5;
  bundle->SetComputeRoot32BitConstants(0, 1, &step, 0);
  step = 1000;  // the bundle has a copy
  bundle->Dispatch(1, 1, 1);
  ASSERT_EQ(bundle->Close(), S_OK);

  // The root signature and the buffer are the list's.
  list_->SetComputeRootSignature(root_signature_.Get());
  list_->SetComputeRootUnorderedAccessView(1, sum->GetGPUVirtualAddress());
  D3D12_RESOURCE_BARRIER between = {};
  between.Type = D3D12_RESOURCE_BARRIER_TYPE_UAV;
  for (int i = 0; i < 3; ++i) {
    list_->ExecuteBundle(bundle.Get());
    list_->ResourceBarrier(1, &between);
  }
  D3D12_RESOURCE_BARRIER barrier = {};
  barrier.Transition = {sum.Get(), 0, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                        D3D12_RESOURCE_STATE_COPY_SOURCE};
  list_->ResourceBarrier(1, &barrier);
  const auto readback = buffer(4, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  list_->CopyResource(readback.Get(), sum.Get());
  run();
  uint32_t* result = nullptr;
  ASSERT_EQ(readback->Map(0, nullptr, reinterpret_cast<void**>(&result)), S_OK);
  EXPECT_EQ(*result, 15u);
  EXPECT_TRUE(messages().empty());

  ASSERT_EQ(bundle_allocator_->Reset(), S_OK);
  EXPECT_EQ(bundle->Reset(bundle_allocator_.Get(), nullptr), S_OK);
  EXPECT_EQ(bundle->Close(), S_OK);
}

TEST_F(BundleCalls, WhatIsNoClosedBundleIsRefused) {
  ComPtr<ID3D12GraphicsCommandList4> bundle;
  ASSERT_EQ(create_bundle(nullptr, bundle), S_OK);
  list_->ExecuteBundle(nullptr);
  list_->ExecuteBundle(list_.Get());
  list_->ExecuteBundle(bundle.Get());  // open
  EXPECT_EQ(messages().size(), 3u);
  ComPtr<ID3D12GraphicsCommandList4> second;
  EXPECT_EQ(create_bundle(nullptr, second), E_INVALIDARG);  // the allocator is taken
  EXPECT_EQ(bundle->Close(), S_OK);
  EXPECT_EQ(bundle->Close(), E_FAIL);
  bundle->Dispatch(1, 1, 1);
  EXPECT_EQ(bundle->Reset(allocator_.Get(), nullptr), E_INVALIDARG);
  messages().clear();
  ID3D12CommandList* lists[] = {bundle.Get()};
  queue_->ExecuteCommandLists(1, lists);
  EXPECT_EQ(messages().size(), 1u);
}

}  // namespace
}  // namespace kaamos::d3d12
