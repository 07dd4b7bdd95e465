// SPDX-License-Identifier: MIT
// Targets of every dimension, and copies of parts of them, on each backend.
#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <directx/d3dx12.h>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

constexpr DXGI_FORMAT kFormat = DXGI_FORMAT_R32_UINT;

class TargetRegions : public D3d12BackendTest {
 protected:
  void SetUp() override {
    D3d12BackendTest::SetUp();
    if (IsSkipped()) return;
    const D3D12_DESCRIPTOR_HEAP_DESC heap = {D3D12_DESCRIPTOR_HEAP_TYPE_RTV, 2,
                                             D3D12_DESCRIPTOR_HEAP_FLAG_NONE, 0};
    ASSERT_EQ(device_->CreateDescriptorHeap(&heap, IID_PPV_ARGS(rtvs_.GetAddressOf())), S_OK);
    readback_ = buffer(16384, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  }

  ComPtr<ID3D12Resource> target(const D3D12_RESOURCE_DESC& desc) {
    const CD3DX12_HEAP_PROPERTIES heap(D3D12_HEAP_TYPE_DEFAULT);
    ComPtr<ID3D12Resource> out;
    EXPECT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                               D3D12_RESOURCE_STATE_RENDER_TARGET, nullptr,
                                               IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    return out;
  }
  D3D12_CPU_DESCRIPTOR_HANDLE rtv(UINT index = 0) const {
    return CD3DX12_CPU_DESCRIPTOR_HANDLE(
        rtvs_->GetCPUDescriptorHandleForHeapStart(), static_cast<INT>(index),
        device_->GetDescriptorHandleIncrementSize(D3D12_DESCRIPTOR_HEAP_TYPE_RTV));
  }
  void clear(float value, const D3D12_RECT* rect = nullptr) {
    const float color[4] = {value, 0, 0, 0};
    list_->ClearRenderTargetView(rtv(), color, rect != nullptr ? 1 : 0, rect);
  }
  void change(ID3D12Resource* resource, D3D12_RESOURCE_STATES before, D3D12_RESOURCE_STATES after) {
    const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(resource, before, after);
    list_->ResourceBarrier(1, &barrier);
  }
  // Sets all that a draw to rtv() needs. The vertex shader has the root signature.
  void prepare(const char* vertex_text, const char* pixel_text, D3D12_INPUT_LAYOUT_DESC layout) {
    const auto vertex = compile("vs_6_0", vertex_text);
    const auto pixel = compile("ps_6_0", pixel_text);
    ASSERT_EQ(device_->CreateRootSignature(0, vertex->GetBufferPointer(), vertex->GetBufferSize(),
                                           IID_PPV_ARGS(root_signature_.GetAddressOf())),
              S_OK);
    D3D12_GRAPHICS_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = root_signature_.Get();
    desc.VS = {vertex->GetBufferPointer(), vertex->GetBufferSize()};
    desc.PS = {pixel->GetBufferPointer(), pixel->GetBufferSize()};
    desc.InputLayout = layout;
    desc.BlendState = CD3DX12_BLEND_DESC(D3D12_DEFAULT);
    desc.SampleMask = UINT_MAX;
    desc.RasterizerState = CD3DX12_RASTERIZER_DESC(D3D12_DEFAULT);
    desc.PrimitiveTopologyType = D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE;
    desc.NumRenderTargets = 1;
    desc.RTVFormats[0] = kFormat;
    desc.SampleDesc.Count = 1;
    ASSERT_EQ(device_->CreateGraphicsPipelineState(&desc, IID_PPV_ARGS(state_.GetAddressOf())),
              S_OK);
    list_->SetGraphicsRootSignature(root_signature_.Get());
    list_->SetPipelineState(state_.Get());
    list_->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
    const D3D12_VIEWPORT viewport = {0, 0, 8, 8, 0, 1};
    list_->RSSetViewports(1, &viewport);
    const D3D12_RECT all = {0, 0, 8, 8};
    list_->RSSetScissorRects(1, &all);
    const auto target = rtv();
    list_->OMSetRenderTargets(1, &target, FALSE, nullptr);
  }
  // Covers the first 8 x 8 texels of one slice for each instance; they get their position.
  void draw(UINT instances) {
    prepare(
        "struct V { float4 at : SV_Position; uint slice : SV_RenderTargetArrayIndex; };"
        "[RootSignature(\"RootFlags(0)\")] V main(uint id : SV_VertexID, uint i : SV_InstanceID) {"
        " V v = {float4(id == 1 ? 3 : -1, id == 2 ? -3 : 1, 0.5, 1), i}; return v; }",
        "uint main(float4 at : SV_Position, uint slice : SV_RenderTargetArrayIndex) : SV_Target "
        "{ return slice * 100 + uint(at.y) * 10 + uint(at.x); }",
        {});
    list_->DrawInstanced(3, instances, 0, 0);
  }
  // The texels of a subresource, x fastest. The texture is in the state COPY_SOURCE.
  std::vector<uint32_t> read(ID3D12Resource* texture, UINT subresource, UINT width, UINT height,
                             UINT depth) {
    const CD3DX12_TEXTURE_COPY_LOCATION to(readback_.Get(),
                                           {0, {kFormat, width, height, depth, 256}});
    const CD3DX12_TEXTURE_COPY_LOCATION from(texture, subresource);
    list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
    run();
    std::vector<uint32_t> out;
    const uint32_t* words = nullptr;
    EXPECT_EQ(readback_->Map(0, nullptr, reinterpret_cast<void**>(const_cast<uint32_t**>(&words))),
              S_OK);
    for (UINT row = 0; row < height * depth; ++row) {
      out.insert(out.end(), words + row * 64, words + row * 64 + width);
    }
    readback_->Unmap(0, nullptr);
    return out;
  }

  ComPtr<ID3D12DescriptorHeap> rtvs_;
  ComPtr<ID3D12Resource> readback_;
  ComPtr<ID3D12RootSignature> root_signature_;
  ComPtr<ID3D12PipelineState> state_;
};

INSTANTIATE_TEST_SUITE_P(Backends, TargetRegions, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return std::string(backend.param); });

using Words = std::vector<uint32_t>;

TEST_P(TargetRegions, SlicesOfAVolumeAreElementsOfATarget) {
  const auto texture = target(
      CD3DX12_RESOURCE_DESC::Tex3D(kFormat, 4, 2, 6, 2, D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET));
  D3D12_RENDER_TARGET_VIEW_DESC view = {};
  view.Format = kFormat;
  view.ViewDimension = D3D12_RTV_DIMENSION_TEXTURE3D;
  view.Texture3D = {1, 1, UINT_MAX};  // slices 1 and 2 of mip 1: 2 x 1 texels
  device_->CreateRenderTargetView(texture.Get(), &view, rtv());
  clear(9);
  view.Texture3D = {0, 2, 2};  // slices 2 and 3 of mip 0
  device_->CreateRenderTargetView(texture.Get(), &view, rtv());
  draw(2);
  // A part of slice 3 alone, and no slice 7.
  view.Texture3D = {0, 3, 1};
  device_->CreateRenderTargetView(texture.Get(), &view, rtv());
  const D3D12_RECT corner = {3, 1, 4, 2};
  clear(77, &corner);
  EXPECT_TRUE(messages().empty());
  view.Texture3D = {0, 5, 2};
  device_->CreateRenderTargetView(texture.Get(), &view, rtv(1));
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA0730");

  change(texture.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_SOURCE);
  EXPECT_EQ(read(texture.Get(), 1, 2, 1, 3), (Words{0, 0, 9, 9, 9, 9}));
  Words expected(4 * 2 * 6);
  const Words drawn = {0, 1, 2, 3, 10, 11, 12, 13, 100, 101, 102, 103, 110, 111, 112, 77};
  std::copy(drawn.begin(), drawn.end(), expected.begin() + 16);
  EXPECT_EQ(read(texture.Get(), 0, 4, 2, 6), expected);
}

TEST_P(TargetRegions, OneDimensionalTexturesAreTargets) {
  const auto texture = target(
      CD3DX12_RESOURCE_DESC::Tex1D(kFormat, 6, 3, 2, D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET));
  D3D12_RENDER_TARGET_VIEW_DESC view = {};
  view.Format = kFormat;
  view.ViewDimension = D3D12_RTV_DIMENSION_TEXTURE1D;
  view.Texture1D.MipSlice = 1;  // of element 0: 3 texels
  device_->CreateRenderTargetView(texture.Get(), &view, rtv());
  const D3D12_RECT last = {1, 0, 3, 1};
  clear(5, &last);
  view.ViewDimension = D3D12_RTV_DIMENSION_TEXTURE1DARRAY;
  view.Texture1DArray = {0, 1, 2};
  device_->CreateRenderTargetView(texture.Get(), &view, rtv());
  draw(2);
  EXPECT_TRUE(messages().empty());
  view.ViewDimension = D3D12_RTV_DIMENSION_TEXTURE2D;  // it is none
  view.Texture2D = {};
  device_->CreateRenderTargetView(texture.Get(), &view, rtv(1));
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA0730");

  change(texture.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_SOURCE);
  EXPECT_EQ(read(texture.Get(), 1, 3, 1, 1), (Words{0, 5, 5}));
  EXPECT_EQ(read(texture.Get(), 0, 6, 1, 1), Words(6));
  EXPECT_EQ(read(texture.Get(), 2, 6, 1, 1), (Words{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(read(texture.Get(), 4, 6, 1, 1), (Words{100, 101, 102, 103, 104, 105}));
}

// [D3D12: Enhanced barriers, self resource copy]
TEST_P(TargetRegions, ASubresourceIsCopiedBesideItself) {
  const auto texture = target(CD3DX12_RESOURCE_DESC::Tex2D(
      kFormat, 8, 4, 1, 1, 1, 0, D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET));
  device_->CreateRenderTargetView(texture.Get(), nullptr, rtv());
  draw(1);
  change(texture.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COMMON);
  ComPtr<ID3D12GraphicsCommandList7> list;
  ASSERT_EQ(list_->QueryInterface(IID_PPV_ARGS(list.GetAddressOf())), S_OK);
  D3D12_TEXTURE_BARRIER barrier = {};
  barrier.SyncBefore = D3D12_BARRIER_SYNC_ALL;
  barrier.SyncAfter = D3D12_BARRIER_SYNC_COPY;
  barrier.AccessBefore = D3D12_BARRIER_ACCESS_COMMON;
  barrier.AccessAfter = D3D12_BARRIER_ACCESS_COPY_SOURCE | D3D12_BARRIER_ACCESS_COPY_DEST;
  barrier.LayoutBefore = barrier.LayoutAfter = D3D12_BARRIER_LAYOUT_COMMON;
  barrier.pResource = texture.Get();
  barrier.Subresources = {0, 1, 0, 0, 0, 1};  // NumArraySlices 0: one
  D3D12_BARRIER_GROUP group = {};
  group.Type = D3D12_BARRIER_TYPE_TEXTURE;
  group.NumBarriers = 1;
  group.pTextureBarriers = &barrier;
  list->Barrier(1, &group);
  const CD3DX12_TEXTURE_COPY_LOCATION both(texture.Get(), 0);
  const D3D12_BOX box = {0, 0, 0, 4, 2, 1};
  list_->CopyTextureRegion(&both, 4, 2, 0, &both, &box);
  EXPECT_TRUE(messages().empty()) << messages()[0];
  const Words words = read(texture.Get(), 0, 8, 4, 1);
  EXPECT_EQ(Words(words.begin() + 16, words.begin() + 24), (Words{20, 21, 22, 23, 0, 1, 2, 3}));
  EXPECT_EQ(Words(words.begin() + 24, words.end()), (Words{30, 31, 32, 33, 10, 11, 12, 13}));
}

// All samples of the texels go along.
TEST_P(TargetRegions, PartsOfMultisampledTexturesAreCopied) {
  const DXGI_FORMAT format = DXGI_FORMAT_R32_FLOAT;
  const auto make = [&](UINT samples) {
    return target(CD3DX12_RESOURCE_DESC::Tex2D(format, 4, 4, 1, 1, samples, 0,
                                               D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET));
  };
  const auto source = make(4), dest = make(4), one = make(1);
  const float black[4] = {}, red[4] = {1, 0, 0, 0};
  device_->CreateRenderTargetView(source.Get(), nullptr, rtv(0));
  device_->CreateRenderTargetView(dest.Get(), nullptr, rtv(1));
  list_->ClearRenderTargetView(rtv(0), red, 0, nullptr);
  list_->ClearRenderTargetView(rtv(1), black, 0, nullptr);
  change(source.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_SOURCE);
  change(dest.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_DEST);
  change(one.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_RESOLVE_DEST);
  const CD3DX12_TEXTURE_COPY_LOCATION to(dest.Get(), 0), from(source.Get(), 0);
  const D3D12_BOX box = {0, 0, 0, 2, 1, 1};
  list_->CopyTextureRegion(&to, 1, 2, 0, &from, &box);
  change(dest.Get(), D3D12_RESOURCE_STATE_COPY_DEST, D3D12_RESOURCE_STATE_RESOLVE_SOURCE);
  D3D12_RECT pixel = {2, 2, 3, 3};
  list_->ResolveSubresourceRegion(dest.Get(), 0, 0, 0, dest.Get(), 0, &pixel, format,
                                  D3D12_RESOLVE_MODE_DECOMPRESS);
  list_->ResolveSubresource(one.Get(), 0, dest.Get(), 0, format);
  change(one.Get(), D3D12_RESOURCE_STATE_RESOLVE_DEST, D3D12_RESOURCE_STATE_COPY_SOURCE);
  const CD3DX12_TEXTURE_COPY_LOCATION bytes(readback_.Get(), {0, {format, 4, 4, 1, 256}});
  const CD3DX12_TEXTURE_COPY_LOCATION resolved(one.Get(), 0);
  list_->CopyTextureRegion(&bytes, 0, 0, 0, &resolved, nullptr);
  run();
  EXPECT_TRUE(messages().empty());
  const float* texels = nullptr;
  ASSERT_EQ(readback_->Map(0, nullptr, reinterpret_cast<void**>(const_cast<float**>(&texels))),
            S_OK);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const bool copied = (y == 2 && (x == 1 || x == 2)) || (y == 0 && x == 0);
      EXPECT_EQ(texels[y * 64 + x], copied ? 1.0f : 0.0f) << x << ", " << y;
    }
  }
  readback_->Unmap(0, nullptr);
}

// As in Microsoft's runtimes; a view of address 0 unsets its slot.
TEST_P(TargetRegions, NullPointersToVertexBufferViewsAreIgnored) {
  const auto texture = target(CD3DX12_RESOURCE_DESC::Tex2D(
      kFormat, 1, 1, 1, 1, 1, 0, D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET));
  device_->CreateRenderTargetView(texture.Get(), nullptr, rtv());
  const D3D12_INPUT_ELEMENT_DESC elements[] = {
      {"A", 0, DXGI_FORMAT_R32_UINT, 0, 0, D3D12_INPUT_CLASSIFICATION_PER_VERTEX_DATA, 0},
      {"B", 0, DXGI_FORMAT_R32_UINT, 1, 0, D3D12_INPUT_CLASSIFICATION_PER_VERTEX_DATA, 0}};
  prepare(
      "struct V { float4 at : SV_Position; nointerpolation uint sum : SUM; };"
      "[RootSignature(\"RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT)\")]"
      "V main(uint id : SV_VertexID, uint a : A, uint b : B) {"
      " V v = {float4(id == 1 ? 3 : -1, id == 2 ? -3 : 1, 0.5, 1), a + b}; return v; }",
      "uint main(float4 at : SV_Position, nointerpolation uint sum : SUM) : SV_Target "
      "{ return sum; }",
      {elements, 2});
  const auto vertices = buffer(16, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  uint32_t* words = nullptr;
  ASSERT_EQ(vertices->Map(0, nullptr, reinterpret_cast<void**>(&words)), S_OK);
  std::fill_n(words, 4, 7u);
  vertices->Unmap(0, nullptr);
  D3D12_VERTEX_BUFFER_VIEW views[2] = {{vertices->GetGPUVirtualAddress(), 16, 4},
                                       {vertices->GetGPUVirtualAddress(), 16, 4}};
  list_->IASetVertexBuffers(0, 2, views);
  views[1] = {};
  list_->IASetVertexBuffers(1, 1, views + 1);
  list_->IASetVertexBuffers(0, 2, nullptr);
  list_->DrawInstanced(3, 1, 0, 0);
  EXPECT_TRUE(messages().empty());
  change(texture.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_SOURCE);
  EXPECT_EQ(read(texture.Get(), 0, 1, 1, 1), Words{7});
}

}  // namespace
}  // namespace kaamos::d3d12
