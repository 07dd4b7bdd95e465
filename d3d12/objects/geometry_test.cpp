// SPDX-License-Identifier: MIT
// Geometry shaders of Direct3D 12 programs, in descriptions and in streams of pipelines.
#include <string>

#include <directx/d3dx12.h>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

constexpr UINT kSide = 16;
constexpr UINT kRowPitch = 256;
constexpr DXGI_FORMAT kFormat = DXGI_FORMAT_R8G8B8A8_UNORM;

class GeometryDraws : public D3d12Test {
 protected:
  void SetUp() override {
    D3d12Test::SetUp();
    vertex_ =
        compile("vs_5_0",
                "[RootSignature(\"RootFlags(0), RootConstants(num32BitConstants = 1, b0)\")]\n"
                "float4 main() : SV_Position { return float4(0, 0, 0.5, 1); }");
    // A square of `half_side` pixels to each side of the point.
    geometry_ = compile("gs_5_0", R"(
cbuffer Size : register(b0) { float half_side; }
struct Corner { float4 position : SV_Position; };
[maxvertexcount(4)]
void main(point float4 center[1] : SV_Position, inout TriangleStream<Corner> output) {
  for (uint i = 0; i < 4; ++i) {
    Corner corner;
    corner.position = center[0];
    corner.position.xy += (float2(i & 1, i >> 1) * 2 - 1) * half_side / 8;
    output.Append(corner);
  }
})");
    pixel_ = compile("ps_5_0", "float4 main() : SV_Target { return 1; }");
    ASSERT_EQ(device_->CreateRootSignature(0, vertex_->GetBufferPointer(), vertex_->GetBufferSize(),
                                           IID_PPV_ARGS(root_signature_.GetAddressOf())),
              S_OK);
    const D3D12_DESCRIPTOR_HEAP_DESC heap = {D3D12_DESCRIPTOR_HEAP_TYPE_RTV, 1,
                                             D3D12_DESCRIPTOR_HEAP_FLAG_NONE, 0};
    ASSERT_EQ(device_->CreateDescriptorHeap(&heap, IID_PPV_ARGS(rtvs_.GetAddressOf())), S_OK);
    readback_ =
        buffer(UINT64{kRowPitch} * kSide, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
    const CD3DX12_HEAP_PROPERTIES memory(D3D12_HEAP_TYPE_DEFAULT);
    const auto desc = CD3DX12_RESOURCE_DESC::Tex2D(kFormat, kSide, kSide, 1, 1, 1, 0,
                                                   D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET);
    ASSERT_EQ(device_->CreateCommittedResource(&memory, D3D12_HEAP_FLAG_NONE, &desc,
                                               D3D12_RESOURCE_STATE_RENDER_TARGET, nullptr,
                                               IID_PPV_ARGS(target_.GetAddressOf())),
              S_OK);
    device_->CreateRenderTargetView(target_.Get(), nullptr, rtv());
  }
  D3D12_CPU_DESCRIPTOR_HANDLE rtv() const { return rtvs_->GetCPUDescriptorHandleForHeapStart(); }

  HRESULT from_desc(D3D12_PRIMITIVE_TOPOLOGY_TYPE type, ComPtr<ID3D12PipelineState>& out) {
    D3D12_GRAPHICS_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = root_signature_.Get();
    desc.VS = CD3DX12_SHADER_BYTECODE(vertex_.Get());
    desc.GS = CD3DX12_SHADER_BYTECODE(geometry_.Get());
    desc.PS = CD3DX12_SHADER_BYTECODE(pixel_.Get());
    desc.BlendState = CD3DX12_BLEND_DESC(D3D12_DEFAULT);
    desc.SampleMask = UINT_MAX;
    desc.RasterizerState = CD3DX12_RASTERIZER_DESC(D3D12_DEFAULT);
    desc.RasterizerState.CullMode = D3D12_CULL_MODE_NONE;
    desc.PrimitiveTopologyType = type;
    desc.NumRenderTargets = 1;
    desc.RTVFormats[0] = kFormat;
    desc.SampleDesc.Count = 1;
    return device_->CreateGraphicsPipelineState(&desc, IID_PPV_ARGS(out.ReleaseAndGetAddressOf()));
  }
  HRESULT from_stream(ComPtr<ID3D12PipelineState>& out) {
    struct {
      CD3DX12_PIPELINE_STATE_STREAM_ROOT_SIGNATURE root_signature;
      CD3DX12_PIPELINE_STATE_STREAM_VS vertex;
      CD3DX12_PIPELINE_STATE_STREAM_GS geometry;
      CD3DX12_PIPELINE_STATE_STREAM_PS pixel;
      CD3DX12_PIPELINE_STATE_STREAM_RASTERIZER rasterizer;
      CD3DX12_PIPELINE_STATE_STREAM_PRIMITIVE_TOPOLOGY topology;
      CD3DX12_PIPELINE_STATE_STREAM_RENDER_TARGET_FORMATS targets;
    } stream;
    stream.root_signature = root_signature_.Get();
    stream.vertex = CD3DX12_SHADER_BYTECODE(vertex_.Get());
    stream.geometry = CD3DX12_SHADER_BYTECODE(geometry_.Get());
    stream.pixel = CD3DX12_SHADER_BYTECODE(pixel_.Get());
    CD3DX12_RASTERIZER_DESC rasterizer(D3D12_DEFAULT);
    rasterizer.CullMode = D3D12_CULL_MODE_NONE;
    stream.rasterizer = rasterizer;
    stream.topology = D3D12_PRIMITIVE_TOPOLOGY_TYPE_POINT;
    D3D12_RT_FORMAT_ARRAY formats = {};
    formats.NumRenderTargets = 1;
    formats.RTFormats[0] = kFormat;
    stream.targets = formats;
    const D3D12_PIPELINE_STATE_STREAM_DESC desc = {sizeof(stream), &stream};
    return device_->CreatePipelineState(&desc, IID_PPV_ARGS(out.ReleaseAndGetAddressOf()));
  }
  void transition(D3D12_RESOURCE_STATES before, D3D12_RESOURCE_STATES after) {
    const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(target_.Get(), before, after);
    list_->ResourceBarrier(1, &barrier);
  }
  // Draws one point, and expects a square.
  void expect_square(ID3D12PipelineState* pipeline, int half_side) {
    const D3D12_CPU_DESCRIPTOR_HANDLE color = rtv();
    const float black[4] = {0, 0, 0, 0};
    list_->ClearRenderTargetView(color, black, 0, nullptr);
    list_->OMSetRenderTargets(1, &color, FALSE, nullptr);
    list_->SetGraphicsRootSignature(root_signature_.Get());
    const auto size = static_cast<float>(half_side);
    list_->SetGraphicsRoot32BitConstants(0, 1, &size, 0);
    list_->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_POINTLIST);
    const D3D12_VIEWPORT viewport = {0, 0, kSide, kSide, 0, 1};
    list_->RSSetViewports(1, &viewport);
    const D3D12_RECT all = {0, 0, kSide, kSide};
    list_->RSSetScissorRects(1, &all);
    list_->SetPipelineState(pipeline);
    list_->DrawInstanced(1, 1, 0, 0);
    transition(D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_SOURCE);
    D3D12_PLACED_SUBRESOURCE_FOOTPRINT footprint = {};
    footprint.Footprint = {kFormat, kSide, kSide, 1, kRowPitch};
    const CD3DX12_TEXTURE_COPY_LOCATION to(readback_.Get(), footprint);
    const CD3DX12_TEXTURE_COPY_LOCATION from(target_.Get(), 0);
    list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
    run();
    void* data = nullptr;
    ASSERT_EQ(readback_->Map(0, nullptr, &data), S_OK);
    constexpr int kMiddle = kSide / 2;
    for (int y = 0; y < static_cast<int>(kSide); ++y) {
      for (int x = 0; x < static_cast<int>(kSide); ++x) {
        const bool inside = x >= kMiddle - half_side && x < kMiddle + half_side &&
                            y >= kMiddle - half_side && y < kMiddle + half_side;
        const auto red = static_cast<const unsigned char*>(data)[y * int{kRowPitch} + x * 4];
        EXPECT_EQ(red, inside ? 255 : 0) << x << ", " << y;
      }
    }
    readback_->Unmap(0, nullptr);
  }

  ComPtr<ID3DBlob> vertex_, geometry_, pixel_;
  ComPtr<ID3D12RootSignature> root_signature_;
  ComPtr<ID3D12Resource> target_, readback_;
  ComPtr<ID3D12DescriptorHeap> rtvs_;
};

TEST_F(GeometryDraws, PointsBecomeSquares) {
  ComPtr<ID3D12PipelineState> pipeline;
  ASSERT_EQ(from_desc(D3D12_PRIMITIVE_TOPOLOGY_TYPE_POINT, pipeline), S_OK);
  expect_square(pipeline.Get(), 3);
  EXPECT_TRUE(messages().empty()) << messages().front();
}

TEST_F(GeometryDraws, StreamsOfPipelinesHaveThem) {
  ComPtr<ID3D12PipelineState> pipeline;
  ASSERT_EQ(from_stream(pipeline), S_OK);
  expect_square(pipeline.Get(), 5);
  EXPECT_TRUE(messages().empty()) << messages().front();
}

TEST_F(GeometryDraws, OtherPrimitivesAreRefused) {
  ComPtr<ID3D12PipelineState> pipeline;
  EXPECT_EQ(from_desc(D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE, pipeline), E_INVALIDARG);
  ASSERT_FALSE(messages().empty());
  EXPECT_NE(messages().front().find("KA0724"), std::string::npos) << messages().front();
}

}  // namespace
}  // namespace kaamos::d3d12
