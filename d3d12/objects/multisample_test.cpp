// SPDX-License-Identifier: MIT
// Multisampled targets of Direct3D 12 programs: what they ask for, draw to and resolve.
#include <cstring>
#include <string>

#include <directx/d3dx12.h>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

constexpr UINT kSide = 16;
constexpr UINT kRowPitch = 256;
constexpr DXGI_FORMAT kFormat = DXGI_FORMAT_R8G8B8A8_UNORM;

class MultisampleDraws : public D3d12Test {
 protected:
  void SetUp() override {
    D3d12Test::SetUp();
    // The left upper triangle, whose diagonal goes through the middle of pixels (x, 15 - x).
    vertex_ = compile("vs_6_0",
                      "[RootSignature(\"RootFlags(0)\")] float4 main(uint id : SV_VertexID) : "
                      "SV_Position { return float4(id == 1 ? 1 : -1, id == 2 ? -1 : 1, 0.5, 1); }");
    pixel_ = compile("ps_6_0", "float4 main() : SV_Target { return 1; }");
    ASSERT_EQ(device_->CreateRootSignature(0, vertex_->GetBufferPointer(), vertex_->GetBufferSize(),
                                           IID_PPV_ARGS(root_signature_.GetAddressOf())),
              S_OK);
    const D3D12_DESCRIPTOR_HEAP_DESC heap = {D3D12_DESCRIPTOR_HEAP_TYPE_RTV, 1,
                                             D3D12_DESCRIPTOR_HEAP_FLAG_NONE, 0};
    ASSERT_EQ(device_->CreateDescriptorHeap(&heap, IID_PPV_ARGS(rtvs_.GetAddressOf())), S_OK);
    readback_ =
        buffer(UINT64{kRowPitch} * kSide, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
    many_ = target(4, D3D12_RESOURCE_STATE_RENDER_TARGET);
    one_ = target(1, D3D12_RESOURCE_STATE_RESOLVE_DEST);
    D3D12_RENDER_TARGET_VIEW_DESC view = {};
    view.Format = kFormat;
    view.ViewDimension = D3D12_RTV_DIMENSION_TEXTURE2DMS;
    device_->CreateRenderTargetView(many_.Get(), &view, rtv());
  }

  static D3D12_RESOURCE_DESC desc_of(UINT samples) {
    return CD3DX12_RESOURCE_DESC::Tex2D(kFormat, kSide, kSide, 1, 1, samples, 0,
                                        D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET);
  }
  ComPtr<ID3D12Resource> target(UINT samples, D3D12_RESOURCE_STATES state) {
    const CD3DX12_HEAP_PROPERTIES heap(D3D12_HEAP_TYPE_DEFAULT);
    const D3D12_RESOURCE_DESC desc = desc_of(samples);
    ComPtr<ID3D12Resource> out;
    EXPECT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc, state, nullptr,
                                               IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    return out;
  }
  D3D12_CPU_DESCRIPTOR_HANDLE rtv() const { return rtvs_->GetCPUDescriptorHandleForHeapStart(); }

  HRESULT pipeline(UINT samples, ComPtr<ID3D12PipelineState>& out) {
    D3D12_GRAPHICS_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = root_signature_.Get();
    desc.VS = {vertex_->GetBufferPointer(), vertex_->GetBufferSize()};
    desc.PS = {pixel_->GetBufferPointer(), pixel_->GetBufferSize()};
    desc.BlendState = CD3DX12_BLEND_DESC(D3D12_DEFAULT);
    desc.SampleMask = UINT_MAX;
    desc.RasterizerState = CD3DX12_RASTERIZER_DESC(D3D12_DEFAULT);
    desc.RasterizerState.MultisampleEnable = TRUE;
    desc.PrimitiveTopologyType = D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE;
    desc.NumRenderTargets = 1;
    desc.RTVFormats[0] = kFormat;
    desc.SampleDesc.Count = samples;
    return device_->CreateGraphicsPipelineState(&desc, IID_PPV_ARGS(out.ReleaseAndGetAddressOf()));
  }
  void draw() {
    ASSERT_EQ(pipeline(4, state_), S_OK);
    list_->SetGraphicsRootSignature(root_signature_.Get());
    list_->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
    const D3D12_VIEWPORT viewport = {0, 0, kSide, kSide, 0, 1};
    list_->RSSetViewports(1, &viewport);
    const D3D12_RECT all = {0, 0, kSide, kSide};
    list_->RSSetScissorRects(1, &all);
    list_->SetPipelineState(state_.Get());
    list_->DrawInstanced(3, 1, 0, 0);
  }
  void change(ID3D12Resource* resource, D3D12_RESOURCE_STATES before, D3D12_RESOURCE_STATES after) {
    const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(resource, before, after);
    list_->ResourceBarrier(1, &barrier);
  }
  // Reads the texture that was resolved to, and compares it with the triangle.
  void expect_triangle() {
    change(one_.Get(), D3D12_RESOURCE_STATE_RESOLVE_DEST, D3D12_RESOURCE_STATE_COPY_SOURCE);
    D3D12_PLACED_SUBRESOURCE_FOOTPRINT footprint = {};
    footprint.Footprint = {kFormat, kSide, kSide, 1, kRowPitch};
    const CD3DX12_TEXTURE_COPY_LOCATION to(readback_.Get(), footprint);
    const CD3DX12_TEXTURE_COPY_LOCATION from(one_.Get(), 0);
    list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
    run();
    void* data = nullptr;
    ASSERT_EQ(readback_->Map(0, nullptr, &data), S_OK);
    for (UINT y = 0; y < kSide; ++y) {
      for (UINT x = 0; x < kSide; ++x) {
        const auto red = static_cast<const unsigned char*>(data)[y * kRowPitch + x * 4];
        // Samples 0 and 2 of a pixel on the diagonal are inside: (-2, -6), (-6, 2).
        const int expected = x + y < kSide - 1 ? 255 : x + y == kSide - 1 ? 128 : 0;
        EXPECT_NEAR(red, expected, 1) << x << ", " << y;
      }
    }
    readback_->Unmap(0, nullptr);
  }

  ComPtr<ID3DBlob> vertex_, pixel_;
  ComPtr<ID3D12RootSignature> root_signature_;
  ComPtr<ID3D12PipelineState> state_;
  ComPtr<ID3D12Resource> many_, one_, readback_;
  ComPtr<ID3D12DescriptorHeap> rtvs_;
};

TEST_F(MultisampleDraws, DevicesSayWhichCountsTheyHave) {
  const auto levels = [&](DXGI_FORMAT format, UINT count) {
    D3D12_FEATURE_DATA_MULTISAMPLE_QUALITY_LEVELS data = {format, count, {}, 9};
    EXPECT_EQ(
        device_->CheckFeatureSupport(D3D12_FEATURE_MULTISAMPLE_QUALITY_LEVELS, &data, sizeof(data)),
        S_OK);
    return data.NumQualityLevels;
  };
  EXPECT_EQ(levels(kFormat, 1), 1u);
  EXPECT_EQ(levels(kFormat, 4), 1u);
  EXPECT_EQ(levels(DXGI_FORMAT_D32_FLOAT, 4), 1u);
  EXPECT_EQ(levels(kFormat, 3), 0u);
  EXPECT_EQ(levels(kFormat, 16), 0u);
  EXPECT_EQ(levels(DXGI_FORMAT_BC1_UNORM, 4), 0u);
}

TEST_F(MultisampleDraws, AreResolvedByACall) {
  const D3D12_CPU_DESCRIPTOR_HANDLE color = rtv();
  const float black[4] = {0, 0, 0, 0};
  list_->ClearRenderTargetView(color, black, 0, nullptr);
  list_->OMSetRenderTargets(1, &color, FALSE, nullptr);
  draw();
  change(many_.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_RESOLVE_SOURCE);
  list_->ResolveSubresource(one_.Get(), 0, many_.Get(), 0, kFormat);
  expect_triangle();
  EXPECT_TRUE(messages().empty()) << messages().front();
}

TEST_F(MultisampleDraws, AreResolvedAtTheEndOfARenderPass) {
  D3D12_RENDER_PASS_ENDING_ACCESS_RESOLVE_SUBRESOURCE_PARAMETERS part = {};
  part.SrcRect = {0, 0, kSide, kSide};
  D3D12_RENDER_PASS_RENDER_TARGET_DESC target = {};
  target.cpuDescriptor = rtv();
  target.BeginningAccess.Type = D3D12_RENDER_PASS_BEGINNING_ACCESS_TYPE_CLEAR;
  target.BeginningAccess.Clear.ClearValue.Format = kFormat;
  target.EndingAccess.Type = D3D12_RENDER_PASS_ENDING_ACCESS_TYPE_RESOLVE;
  target.EndingAccess.Resolve = {
      many_.Get(), one_.Get(), 1, &part, kFormat, D3D12_RESOLVE_MODE_AVERAGE, FALSE};
  list_->BeginRenderPass(1, &target, nullptr, D3D12_RENDER_PASS_FLAG_NONE);
  draw();
  list_->EndRenderPass();
  expect_triangle();
  EXPECT_TRUE(messages().empty()) << messages().front();
}

TEST_F(MultisampleDraws, CountsThatThereAreNotAreRefused) {
  const CD3DX12_HEAP_PROPERTIES heap(D3D12_HEAP_TYPE_DEFAULT);
  const D3D12_RESOURCE_DESC desc = desc_of(3);
  ComPtr<ID3D12Resource> resource;
  EXPECT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                             D3D12_RESOURCE_STATE_RENDER_TARGET, nullptr,
                                             IID_PPV_ARGS(resource.GetAddressOf())),
            E_INVALIDARG);
  ASSERT_FALSE(messages().empty());
  EXPECT_NE(messages().back().find("KA0573"), std::string::npos) << messages().back();
  ComPtr<ID3D12PipelineState> state;
  EXPECT_EQ(pipeline(3, state), E_INVALIDARG);
}

// [D3D12: GetResourceAllocationInfo]
TEST_F(MultisampleDraws, TakeFourMebibytesUnlessTheyAreSmall) {
  const auto info = [&](UINT samples, UINT64 alignment) {
    D3D12_RESOURCE_DESC desc = desc_of(samples);
    desc.Alignment = alignment;
    return device_->GetResourceAllocationInfo(0, 1, &desc);
  };
  EXPECT_EQ(info(1, 0).Alignment, 65536u);
  EXPECT_EQ(info(4, 0).Alignment, 4194304u);
  EXPECT_EQ(info(4, 0).SizeInBytes, 4194304u);
  EXPECT_EQ(info(4, 65536).Alignment, 65536u);
  EXPECT_EQ(info(4, 65536).SizeInBytes, 65536u);
  EXPECT_EQ(info(4, 4096).SizeInBytes, UINT64_MAX);
}

}  // namespace
}  // namespace kaamos::d3d12
