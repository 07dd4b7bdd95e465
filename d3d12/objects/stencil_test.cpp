// SPDX-License-Identifier: MIT
// Stencil of draws: the descriptions that pipelines take, and references in lists and bundles.
#include <cstring>
#include <string>

#include <directx/d3dx12.h>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

constexpr UINT kSide = 16;
constexpr UINT kRowPitch = 256;

class StencilDraws : public D3d12Test {
 protected:
  void SetUp() override {
    D3d12Test::SetUp();
    vertex_ = compile("vs_6_0",
                      "[RootSignature(\"RootFlags(0)\")] float4 main(uint id : SV_VertexID) : "
                      "SV_Position { return float4(id == 1 ? 3 : -1, id == 2 ? -3 : 1, 0.5, 1); }");
    pixel_ = compile("ps_6_0", "float4 main() : SV_Target { return 1; }");
    ASSERT_EQ(device_->CreateRootSignature(0, vertex_->GetBufferPointer(), vertex_->GetBufferSize(),
                                           IID_PPV_ARGS(root_signature_.GetAddressOf())),
              S_OK);
    color_ = target(DXGI_FORMAT_R8G8B8A8_UNORM, D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET,
                    D3D12_RESOURCE_STATE_RENDER_TARGET);
    depth_ = target(DXGI_FORMAT_D24_UNORM_S8_UINT, D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL,
                    D3D12_RESOURCE_STATE_DEPTH_WRITE);
    rtvs_ = heap(D3D12_DESCRIPTOR_HEAP_TYPE_RTV);
    dsvs_ = heap(D3D12_DESCRIPTOR_HEAP_TYPE_DSV);
    device_->CreateRenderTargetView(color_.Get(), nullptr, rtv());
    device_->CreateDepthStencilView(depth_.Get(), nullptr, dsv());
    readback_ =
        buffer(UINT64{kRowPitch} * kSide, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  }

  ComPtr<ID3D12Resource> target(DXGI_FORMAT format, D3D12_RESOURCE_FLAGS flags,
                                D3D12_RESOURCE_STATES state) {
    const CD3DX12_HEAP_PROPERTIES heap(D3D12_HEAP_TYPE_DEFAULT);
    const auto desc = CD3DX12_RESOURCE_DESC::Tex2D(format, kSide, kSide, 1, 1, 1, 0, flags);
    ComPtr<ID3D12Resource> out;
    EXPECT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc, state, nullptr,
                                               IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    return out;
  }
  ComPtr<ID3D12DescriptorHeap> heap(D3D12_DESCRIPTOR_HEAP_TYPE type) {
    const D3D12_DESCRIPTOR_HEAP_DESC desc = {type, 1, D3D12_DESCRIPTOR_HEAP_FLAG_NONE, 0};
    ComPtr<ID3D12DescriptorHeap> out;
    EXPECT_EQ(device_->CreateDescriptorHeap(&desc, IID_PPV_ARGS(out.GetAddressOf())), S_OK);
    return out;
  }
  D3D12_CPU_DESCRIPTOR_HANDLE rtv() const { return rtvs_->GetCPUDescriptorHandleForHeapStart(); }
  D3D12_CPU_DESCRIPTOR_HANDLE dsv() const { return dsvs_->GetCPUDescriptorHandleForHeapStart(); }

  // Stencil that writes the reference.
  ComPtr<ID3D12PipelineState> marker() {
    D3D12_GRAPHICS_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = root_signature_.Get();
    desc.VS = {vertex_->GetBufferPointer(), vertex_->GetBufferSize()};
    desc.BlendState = CD3DX12_BLEND_DESC(D3D12_DEFAULT);
    desc.SampleMask = UINT_MAX;
    desc.RasterizerState = CD3DX12_RASTERIZER_DESC(D3D12_DEFAULT);
    desc.DepthStencilState = CD3DX12_DEPTH_STENCIL_DESC(D3D12_DEFAULT);
    desc.DepthStencilState.DepthEnable = FALSE;
    desc.DepthStencilState.StencilEnable = TRUE;
    desc.DepthStencilState.FrontFace.StencilPassOp = D3D12_STENCIL_OP_REPLACE;
    desc.PrimitiveTopologyType = D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE;
    desc.NumRenderTargets = 1;
    desc.RTVFormats[0] = DXGI_FORMAT_R8G8B8A8_UNORM;
    desc.DSVFormat = DXGI_FORMAT_D24_UNORM_S8_UINT;
    desc.SampleDesc.Count = 1;
    ComPtr<ID3D12PipelineState> out;
    EXPECT_EQ(device_->CreateGraphicsPipelineState(&desc, IID_PPV_ARGS(out.GetAddressOf())), S_OK);
    return out;
  }
  // A pipeline that draws white, made from a stream with this subobject.
  template <class DepthStencil>
  HRESULT white(const DepthStencil& depth_stencil, ComPtr<ID3D12PipelineState>& out) {
    struct {
      CD3DX12_PIPELINE_STATE_STREAM_ROOT_SIGNATURE root_signature;
      CD3DX12_PIPELINE_STATE_STREAM_VS vertex;
      CD3DX12_PIPELINE_STATE_STREAM_PS pixel;
      CD3DX12_PIPELINE_STATE_STREAM_PRIMITIVE_TOPOLOGY topology;
      CD3DX12_PIPELINE_STATE_STREAM_RENDER_TARGET_FORMATS targets;
      CD3DX12_PIPELINE_STATE_STREAM_DEPTH_STENCIL_FORMAT depth_format;
      DepthStencil depth_stencil;
    } stream;
    stream.root_signature = root_signature_.Get();
    stream.vertex = CD3DX12_SHADER_BYTECODE(vertex_.Get());
    stream.pixel = CD3DX12_SHADER_BYTECODE(pixel_.Get());
    stream.topology = D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE;
    D3D12_RT_FORMAT_ARRAY formats = {};
    formats.NumRenderTargets = 1;
    formats.RTFormats[0] = DXGI_FORMAT_R8G8B8A8_UNORM;
    stream.targets = formats;
    stream.depth_format = DXGI_FORMAT_D24_UNORM_S8_UINT;
    stream.depth_stencil = depth_stencil;
    const D3D12_PIPELINE_STATE_STREAM_DESC desc = {sizeof(stream), &stream};
    return device_->CreatePipelineState(&desc, IID_PPV_ARGS(out.ReleaseAndGetAddressOf()));
  }

  // Clears, and makes stencil 3 in the left half, 0 in the right half.
  void begin() {
    const float black[4] = {0, 0, 0, 0};
    list_->ClearRenderTargetView(rtv(), black, 0, nullptr);
    list_->ClearDepthStencilView(dsv(), D3D12_CLEAR_FLAG_DEPTH | D3D12_CLEAR_FLAG_STENCIL, 1, 0, 0,
                                 nullptr);
    const D3D12_CPU_DESCRIPTOR_HANDLE color = rtv(), depth = dsv();
    list_->OMSetRenderTargets(1, &color, FALSE, &depth);
    list_->SetGraphicsRootSignature(root_signature_.Get());
    list_->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
    const D3D12_VIEWPORT viewport = {0, 0, kSide, kSide, 0, 1};
    list_->RSSetViewports(1, &viewport);
    const D3D12_RECT left = {0, 0, kSide / 2, kSide};
    list_->RSSetScissorRects(1, &left);
    const ComPtr<ID3D12PipelineState> mark = marker();
    kept_.push_back(mark);
    list_->SetPipelineState(mark.Get());
    list_->OMSetStencilRef(3);
    list_->DrawInstanced(3, 1, 0, 0);
    const D3D12_RECT all = {0, 0, kSide, kSide};
    list_->RSSetScissorRects(1, &all);
  }
  // Runs the list, and tells which halves are white: "left", "right", "both", "none", else "mixed".
  std::string finish() {
    D3D12_RESOURCE_BARRIER barrier = CD3DX12_RESOURCE_BARRIER::Transition(
        color_.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_SOURCE);
    list_->ResourceBarrier(1, &barrier);
    D3D12_PLACED_SUBRESOURCE_FOOTPRINT footprint = {};
    footprint.Footprint = {DXGI_FORMAT_R8G8B8A8_UNORM, kSide, kSide, 1, kRowPitch};
    const CD3DX12_TEXTURE_COPY_LOCATION to(readback_.Get(), footprint);
    const CD3DX12_TEXTURE_COPY_LOCATION from(color_.Get(), 0);
    list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
    std::swap(barrier.Transition.StateBefore, barrier.Transition.StateAfter);
    list_->ResourceBarrier(1, &barrier);
    run();
    kept_.clear();
    void* data = nullptr;
    EXPECT_EQ(readback_->Map(0, nullptr, &data), S_OK);
    UINT left = 0, right = 0;
    for (UINT y = 0; y < kSide; ++y) {
      for (UINT x = 0; x < kSide; ++x) {
        UINT texel;
        std::memcpy(&texel, static_cast<const char*>(data) + y * kRowPitch + x * 4, 4);
        (x < kSide / 2 ? left : right) += texel == 0xFFFFFFFFu ? 1 : 0;
      }
    }
    readback_->Unmap(0, nullptr);
    constexpr UINT kHalf = kSide * kSide / 2;
    if (left % kHalf != 0 || right % kHalf != 0) return "mixed";
    return left != 0 ? (right != 0 ? "both" : "left") : (right != 0 ? "right" : "none");
  }

  ComPtr<ID3DBlob> vertex_, pixel_;
  ComPtr<ID3D12RootSignature> root_signature_;
  ComPtr<ID3D12Resource> color_, depth_, readback_;
  ComPtr<ID3D12DescriptorHeap> rtvs_, dsvs_;
  std::vector<ComPtr<ID3D12PipelineState>> kept_;
};

CD3DX12_PIPELINE_STATE_STREAM_DEPTH_STENCIL1 equal_to_reference() {
  CD3DX12_DEPTH_STENCIL_DESC1 desc(D3D12_DEFAULT);
  desc.StencilEnable = TRUE;
  desc.FrontFace.StencilFunc = D3D12_COMPARISON_FUNC_EQUAL;
  desc.BackFace.StencilFunc = D3D12_COMPARISON_FUNC_NEVER;
  return CD3DX12_PIPELINE_STATE_STREAM_DEPTH_STENCIL1(desc);
}

TEST_F(StencilDraws, ListsAndBundlesSetReferences) {
  ComPtr<ID3D12PipelineState> equal;
  ASSERT_EQ(white(equal_to_reference(), equal), S_OK);
  const auto drawn = [&](UINT reference) {
    begin();
    list_->SetPipelineState(equal.Get());
    list_->OMSetStencilRef(reference);
    list_->DrawInstanced(3, 1, 0, 0);
    return finish();
  };
  EXPECT_EQ(drawn(3), "left");
  EXPECT_EQ(drawn(0), "right");
  EXPECT_EQ(drawn(2), "none");
  // A new list begins with 0.
  ComPtr<ID3D12GraphicsCommandList8> newer;
  ASSERT_EQ(list_.As(&newer), S_OK);
  begin();
  list_->ClearState(equal.Get());
  const D3D12_CPU_DESCRIPTOR_HANDLE color = rtv(), depth = dsv();
  list_->OMSetRenderTargets(1, &color, FALSE, &depth);
  list_->SetGraphicsRootSignature(root_signature_.Get());
  list_->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
  const D3D12_VIEWPORT viewport = {0, 0, kSide, kSide, 0, 1};
  list_->RSSetViewports(1, &viewport);
  const D3D12_RECT all = {0, 0, kSide, kSide};
  list_->RSSetScissorRects(1, &all);
  list_->DrawInstanced(3, 1, 0, 0);
  EXPECT_EQ(finish(), "right");
  begin();
  list_->SetPipelineState(equal.Get());
  newer->OMSetFrontAndBackStencilRef(3, 0);
  list_->DrawInstanced(3, 1, 0, 0);
  EXPECT_EQ(finish(), "left");

  ComPtr<ID3D12CommandAllocator> allocator;
  ASSERT_EQ(device_->CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE_BUNDLE,
                                            IID_PPV_ARGS(allocator.GetAddressOf())),
            S_OK);
  ComPtr<ID3D12GraphicsCommandList> bundle;
  ASSERT_EQ(device_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_BUNDLE, allocator.Get(),
                                       equal.Get(), IID_PPV_ARGS(bundle.GetAddressOf())),
            S_OK);
  bundle->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
  bundle->OMSetStencilRef(0);
  bundle->DrawInstanced(3, 1, 0, 0);
  ASSERT_EQ(bundle->Close(), S_OK);
  begin();
  list_->ExecuteBundle(bundle.Get());
  EXPECT_EQ(finish(), "right");
}

TEST_F(StencilDraws, MasksOfDepthStencil2AreOfAFace) {
  CD3DX12_DEPTH_STENCIL_DESC2 desc(D3D12_DEFAULT);
  desc.StencilEnable = TRUE;
  desc.FrontFace.StencilFunc = D3D12_COMPARISON_FUNC_NOT_EQUAL;
  desc.FrontFace.StencilReadMask = 1;
  desc.BackFace.StencilFunc = D3D12_COMPARISON_FUNC_NEVER;
  ComPtr<ID3D12PipelineState> odd;
  ASSERT_EQ(white(CD3DX12_PIPELINE_STATE_STREAM_DEPTH_STENCIL2(desc), odd), S_OK);
  begin();
  list_->SetPipelineState(odd.Get());
  list_->OMSetStencilRef(2);
  list_->DrawInstanced(3, 1, 0, 0);
  EXPECT_EQ(finish(), "left");
}

TEST_F(StencilDraws, RenderPassesClearStencil) {
  ComPtr<ID3D12PipelineState> equal;
  ASSERT_EQ(white(equal_to_reference(), equal), S_OK);
  begin();
  D3D12_RENDER_PASS_RENDER_TARGET_DESC color = {};
  color.cpuDescriptor = rtv();
  color.BeginningAccess.Type = D3D12_RENDER_PASS_BEGINNING_ACCESS_TYPE_PRESERVE;
  color.EndingAccess.Type = D3D12_RENDER_PASS_ENDING_ACCESS_TYPE_PRESERVE;
  D3D12_RENDER_PASS_DEPTH_STENCIL_DESC depth = {};
  depth.cpuDescriptor = dsv();
  depth.DepthBeginningAccess.Type = D3D12_RENDER_PASS_BEGINNING_ACCESS_TYPE_PRESERVE;
  depth.StencilBeginningAccess.Type = D3D12_RENDER_PASS_BEGINNING_ACCESS_TYPE_CLEAR;
  depth.StencilBeginningAccess.Clear.ClearValue.DepthStencil.Stencil = 7;
  depth.DepthEndingAccess.Type = D3D12_RENDER_PASS_ENDING_ACCESS_TYPE_PRESERVE;
  depth.StencilEndingAccess.Type = D3D12_RENDER_PASS_ENDING_ACCESS_TYPE_PRESERVE;
  list_->BeginRenderPass(1, &color, &depth, D3D12_RENDER_PASS_FLAG_NONE);
  list_->SetPipelineState(equal.Get());
  list_->OMSetStencilRef(7);
  list_->DrawInstanced(3, 1, 0, 0);
  list_->EndRenderPass();
  EXPECT_EQ(finish(), "both");
}

TEST_F(StencilDraws, WhatCannotBeIsRefused) {
  ComPtr<ID3D12PipelineState> out;
  CD3DX12_DEPTH_STENCIL_DESC2 desc(D3D12_DEFAULT);
  desc.StencilEnable = TRUE;
  desc.BackFace.StencilPassOp = static_cast<D3D12_STENCIL_OP>(9);
  EXPECT_EQ(white(CD3DX12_PIPELINE_STATE_STREAM_DEPTH_STENCIL2(desc), out), E_INVALIDARG);
  ASSERT_FALSE(messages().empty());
  EXPECT_NE(messages().back().find("BackFace.StencilPassOp is 9"), std::string::npos)
      << messages().back();
  desc = CD3DX12_DEPTH_STENCIL_DESC2(D3D12_DEFAULT);
  desc.DepthBoundsTestEnable = TRUE;
  EXPECT_EQ(white(CD3DX12_PIPELINE_STATE_STREAM_DEPTH_STENCIL2(desc), out), DXGI_ERROR_UNSUPPORTED);
  EXPECT_NE(messages().back().find("DepthBoundsTestEnable"), std::string::npos)
      << messages().back();
}

}  // namespace
}  // namespace kaamos::d3d12
