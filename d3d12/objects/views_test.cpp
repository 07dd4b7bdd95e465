// SPDX-License-Identifier: MIT
// Tests the things that programs bind: views and samplers made in one heap and copied to another,
// textures filled by d3dx12.h's UpdateSubresources, and render passes.
#include <cstring>
#include <string>

#include <d3dcompiler.h>
#include <directx/d3dx12.h>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

class ViewCalls : public D3d12Test {
 protected:
  ComPtr<ID3D12Resource> texture(UINT side, DXGI_FORMAT format, D3D12_RESOURCE_STATES state,
                                 D3D12_RESOURCE_FLAGS flags = D3D12_RESOURCE_FLAG_NONE) {
    const auto desc = CD3DX12_RESOURCE_DESC::Tex2D(format, side, side, 1, 1, 1, 0, flags);
    const CD3DX12_HEAP_PROPERTIES heap(D3D12_HEAP_TYPE_DEFAULT);
    ComPtr<ID3D12Resource> out;
    EXPECT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc, state, nullptr,
                                               IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    return out;
  }

  ComPtr<ID3D12DescriptorHeap> heap(D3D12_DESCRIPTOR_HEAP_TYPE type, UINT count, bool visible) {
    const D3D12_DESCRIPTOR_HEAP_DESC desc = {
        type, count,
        visible ? D3D12_DESCRIPTOR_HEAP_FLAG_SHADER_VISIBLE : D3D12_DESCRIPTOR_HEAP_FLAG_NONE, 0};
    ComPtr<ID3D12DescriptorHeap> out;
    EXPECT_EQ(device_->CreateDescriptorHeap(&desc, IID_PPV_ARGS(out.GetAddressOf())), S_OK);
    return out;
  }

  D3D12_CPU_DESCRIPTOR_HANDLE slot(ID3D12DescriptorHeap* heap, INT index) {
    return CD3DX12_CPU_DESCRIPTOR_HANDLE(
        heap->GetCPUDescriptorHandleForHeapStart(), index,
        device_->GetDescriptorHandleIncrementSize(heap->GetDesc().Type));
  }

  void transition(ID3D12Resource* resource, D3D12_RESOURCE_STATES before,
                  D3D12_RESOURCE_STATES after) {
    const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(resource, before, after);
    list_->ResourceBarrier(1, &barrier);
  }
};

TEST_F(ViewCalls, CopiedDescriptorsBindWhatTheirOriginalsDo) {
  const std::string text =
      "cbuffer Scale : register(b0) { float scale; };"
      "Texture2D<float> picture : register(t0);"
      "SamplerState linear_clamp : register(s0);"
      "RWByteAddressBuffer result : register(u0);"
      "[RootSignature(\"DescriptorTable(CBV(b0), SRV(t0)), DescriptorTable(Sampler(s0)), "
      "UAV(u0)\")]"
      "[numthreads(1, 1, 1)] void main() {"
      "  result.Store(0, asuint(scale * picture.SampleLevel(linear_clamp, float2(0.5, 0.5), 0)));"
      "}";
  ComPtr<ID3DBlob> code;
  ASSERT_EQ(D3DCompile(text.data(), text.size(), "sample.hlsl", nullptr, nullptr, "main", "cs_6_0",
                       0, 0, code.GetAddressOf(), nullptr),
            S_OK);
  ComPtr<ID3D12RootSignature> root_signature;
  ASSERT_EQ(device_->CreateRootSignature(0, code->GetBufferPointer(), code->GetBufferSize(),
                                         IID_PPV_ARGS(root_signature.GetAddressOf())),
            S_OK);
  D3D12_COMPUTE_PIPELINE_STATE_DESC desc = {};
  desc.pRootSignature = root_signature.Get();
  desc.CS = {code->GetBufferPointer(), code->GetBufferSize()};
  ComPtr<ID3D12PipelineState> pipeline;
  ASSERT_EQ(device_->CreateComputePipelineState(&desc, IID_PPV_ARGS(pipeline.GetAddressOf())),
            S_OK);

  // Four texels whose mean is 2.5.
  const auto picture = texture(2, DXGI_FORMAT_R32_FLOAT, D3D12_RESOURCE_STATE_COPY_DEST);
  const UINT64 bytes = GetRequiredIntermediateSize(picture.Get(), 0, 1);
  const auto upload = buffer(bytes, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  const float texels[4] = {1, 2, 3, 4};
  const D3D12_SUBRESOURCE_DATA data = {texels, 8, 16};
  EXPECT_NE(UpdateSubresources(list_.Get(), picture.Get(), upload.Get(), 0, 0, 1, &data), 0u);
  transition(picture.Get(), D3D12_RESOURCE_STATE_COPY_DEST,
             D3D12_RESOURCE_STATE_NON_PIXEL_SHADER_RESOURCE);

  const auto constants = buffer(256, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  float* scale = nullptr;
  ASSERT_EQ(constants->Map(0, nullptr, reinterpret_cast<void**>(&scale)), S_OK);
  *scale = 4;
  const auto views = heap(D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV, 2, false);
  const D3D12_CONSTANT_BUFFER_VIEW_DESC view = {constants->GetGPUVirtualAddress(), 256};
  device_->CreateConstantBufferView(&view, slot(views.Get(), 0));
  device_->CreateShaderResourceView(picture.Get(), nullptr, slot(views.Get(), 1));
  const auto samplers = heap(D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER, 1, false);
  D3D12_SAMPLER_DESC sampler = {};
  sampler.Filter = D3D12_FILTER_MIN_MAG_MIP_LINEAR;
  sampler.AddressU = sampler.AddressV = sampler.AddressW = D3D12_TEXTURE_ADDRESS_MODE_CLAMP;
  sampler.MaxLOD = D3D12_FLOAT32_MAX;
  device_->CreateSampler(&sampler, slot(samplers.Get(), 0));

  const auto bound = heap(D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV, 8, true);
  const auto bound_samplers = heap(D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER, 1, true);
  device_->CopyDescriptorsSimple(2, slot(bound.Get(), 3), slot(views.Get(), 0),
                                 D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV);
  device_->CopyDescriptorsSimple(1, slot(bound_samplers.Get(), 0), slot(samplers.Get(), 0),
                                 D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER);
  const auto result = buffer(4, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                             D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  ID3D12DescriptorHeap* heaps[] = {bound.Get(), bound_samplers.Get()};
  list_->SetDescriptorHeaps(2, heaps);
  list_->SetComputeRootSignature(root_signature.Get());
  list_->SetPipelineState(pipeline.Get());
  list_->SetComputeRootDescriptorTable(
      0, CD3DX12_GPU_DESCRIPTOR_HANDLE(
             bound->GetGPUDescriptorHandleForHeapStart(), 3,
             device_->GetDescriptorHandleIncrementSize(D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV)));
  list_->SetComputeRootDescriptorTable(1, bound_samplers->GetGPUDescriptorHandleForHeapStart());
  list_->SetComputeRootUnorderedAccessView(2, result->GetGPUVirtualAddress());
  list_->Dispatch(1, 1, 1);
  transition(result.Get(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS, D3D12_RESOURCE_STATE_COPY_SOURCE);
  const auto readback = buffer(4, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  list_->CopyResource(readback.Get(), result.Get());
  run();
  float* value = nullptr;
  ASSERT_EQ(readback->Map(0, nullptr, reinterpret_cast<void**>(&value)), S_OK);
  EXPECT_FLOAT_EQ(*value, 10);
  EXPECT_TRUE(messages().empty());
}

TEST_F(ViewCalls, ARenderPassClearsItsTargets) {
  const auto target = texture(4, DXGI_FORMAT_R32_FLOAT, D3D12_RESOURCE_STATE_RENDER_TARGET,
                              D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET);
  const auto views = heap(D3D12_DESCRIPTOR_HEAP_TYPE_RTV, 1, false);
  device_->CreateRenderTargetView(target.Get(), nullptr, slot(views.Get(), 0));
  D3D12_RENDER_PASS_RENDER_TARGET_DESC desc = {};
  desc.cpuDescriptor = slot(views.Get(), 0);
  desc.BeginningAccess.Type = D3D12_RENDER_PASS_BEGINNING_ACCESS_TYPE_CLEAR;
  desc.BeginningAccess.Clear.ClearValue.Format = DXGI_FORMAT_R32_FLOAT;
  desc.BeginningAccess.Clear.ClearValue.Color[0] = 0.25f;
  desc.EndingAccess.Type = D3D12_RENDER_PASS_ENDING_ACCESS_TYPE_PRESERVE;
  list_->BeginRenderPass(1, &desc, nullptr, D3D12_RENDER_PASS_FLAG_NONE);
  list_->EndRenderPass();
  transition(target.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_SOURCE);
  D3D12_PLACED_SUBRESOURCE_FOOTPRINT footprint = {};
  UINT64 bytes = 0;
  const D3D12_RESOURCE_DESC texture = target->GetDesc();
  device_->GetCopyableFootprints(&texture, 0, 1, 0, &footprint, nullptr, nullptr, &bytes);
  const auto readback = buffer(bytes, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  const CD3DX12_TEXTURE_COPY_LOCATION to(readback.Get(), footprint), from(target.Get(), 0);
  list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
  run();
  std::byte* texels = nullptr;
  ASSERT_EQ(readback->Map(0, nullptr, reinterpret_cast<void**>(&texels)), S_OK);
  for (UINT y = 0; y < 4; ++y) {
    float row[4];
    std::memcpy(row, texels + size_t{y} * footprint.Footprint.RowPitch, sizeof(row));
    for (const float value : row) EXPECT_EQ(value, 0.25f);
  }
  EXPECT_TRUE(messages().empty());
}

}  // namespace
}  // namespace kaamos::d3d12
