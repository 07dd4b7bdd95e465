// SPDX-License-Identifier: MIT
// What D3D12's runtimes do beside the rules that programs obey: calls that they drop, descriptions
// that they complete, codes of what they refuse. Each on every backend.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include <d3dcompiler.h>
#include <directx/d3dx12.h>

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

  ComPtr<ID3D12Resource> mip_texture(UINT mips) {
    D3D12_RESOURCE_DESC desc =
        texture_desc(1u << (mips - 1), 1u << (mips - 1), 1, DXGI_FORMAT_R32_FLOAT);
    desc.MipLevels = static_cast<UINT16>(mips);
    D3D12_HEAP_PROPERTIES heap = {};
    heap.Type = D3D12_HEAP_TYPE_DEFAULT;
    ComPtr<ID3D12Resource> out;
    EXPECT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                               D3D12_RESOURCE_STATE_COPY_DEST, nullptr,
                                               IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    for (UINT mip = 0; mip < mips; ++mip) {
      const UINT side = 1u << (mips - 1 - mip);
      const auto upload = buffer(UINT64{256} * side, D3D12_HEAP_TYPE_UPLOAD);
      float* texels = nullptr;
      EXPECT_EQ(upload->Map(0, nullptr, reinterpret_cast<void**>(&texels)), S_OK);
      std::fill_n(texels, 64 * side, static_cast<float>(mip + 1));
      upload->Unmap(0, nullptr);
      const CD3DX12_TEXTURE_COPY_LOCATION to(out.Get(), mip);
      const CD3DX12_TEXTURE_COPY_LOCATION from(upload.Get(),
                                               {0, {DXGI_FORMAT_R32_FLOAT, side, side, 1, 256}});
      list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
      run();
    }
    const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(
        out.Get(), D3D12_RESOURCE_STATE_COPY_DEST, D3D12_RESOURCE_STATE_ALL_SHADER_RESOURCE);
    list_->ResourceBarrier(1, &barrier);
    return out;
  }

  // What a shader loads from a mip and samples, without filtering, at a level of detail.
  std::pair<float, float> read_mips(ID3D12Resource* texture,
                                    const D3D12_SHADER_RESOURCE_VIEW_DESC& view, float mip,
                                    float lod) {
    static constexpr char kShader[] =
        "Texture2D<float> t : register(t0); SamplerState s : register(s0);"
        "RWByteAddressBuffer o : register(u0); cbuffer c : register(b0) { float mip, lod; };"
        "[RootSignature(\"DescriptorTable(SRV(t0)), UAV(u0), RootConstants(num32BitConstants = 2, "
        "b0), StaticSampler(s0, filter = FILTER_MIN_MAG_MIP_POINT)\")]"
        "[numthreads(1, 1, 1)] void main() { o.Store2(0, uint2(asuint(t.Load(int3(0, 0, mip))), "
        "asuint(t.SampleLevel(s, 0.5, lod)))); }";
    ComPtr<ID3DBlob> code;
    EXPECT_EQ(D3DCompile(kShader, std::strlen(kShader), "mips.hlsl", nullptr, nullptr, "main",
                         "cs_6_0", 0, 0, code.GetAddressOf(), nullptr),
              S_OK);
    ComPtr<ID3D12RootSignature> root;
    EXPECT_EQ(device_->CreateRootSignature(0, code->GetBufferPointer(), code->GetBufferSize(),
                                           IID_PPV_ARGS(root.GetAddressOf())),
              S_OK);
    D3D12_COMPUTE_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = root.Get();
    desc.CS = {code->GetBufferPointer(), code->GetBufferSize()};
    ComPtr<ID3D12PipelineState> pipeline;
    EXPECT_EQ(device_->CreateComputePipelineState(&desc, IID_PPV_ARGS(pipeline.GetAddressOf())),
              S_OK);
    const D3D12_DESCRIPTOR_HEAP_DESC heap_desc = {D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV, 1,
                                                  D3D12_DESCRIPTOR_HEAP_FLAG_SHADER_VISIBLE, 0};
    ComPtr<ID3D12DescriptorHeap> heap;
    EXPECT_EQ(device_->CreateDescriptorHeap(&heap_desc, IID_PPV_ARGS(heap.GetAddressOf())), S_OK);
    device_->CreateShaderResourceView(texture, &view, heap->GetCPUDescriptorHandleForHeapStart());
    const auto out = buffer(8, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                            D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
    ID3D12DescriptorHeap* heaps[] = {heap.Get()};
    list_->SetDescriptorHeaps(1, heaps);
    list_->SetComputeRootSignature(root.Get());
    list_->SetPipelineState(pipeline.Get());
    list_->SetComputeRootDescriptorTable(0, heap->GetGPUDescriptorHandleForHeapStart());
    list_->SetComputeRootUnorderedAccessView(1, out->GetGPUVirtualAddress());
    const float constants[] = {mip, lod};
    list_->SetComputeRoot32BitConstants(2, 2, constants, 0);
    list_->Dispatch(1, 1, 1);
    const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(
        out.Get(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS, D3D12_RESOURCE_STATE_COPY_SOURCE);
    list_->ResourceBarrier(1, &barrier);
    const std::vector<uint32_t> words = read(out.Get(), 2);
    float values[2];
    std::memcpy(values, words.data(), sizeof(values));
    return {values[0], values[1]};
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

TEST_P(RuntimeRules, BuffersOfCustomHeapsAreMappedAndWritten) {
  for (const auto page :
       {D3D12_CPU_PAGE_PROPERTY_WRITE_BACK, D3D12_CPU_PAGE_PROPERTY_WRITE_COMBINE}) {
    const D3D12_HEAP_PROPERTIES heap = {D3D12_HEAP_TYPE_CUSTOM, page, D3D12_MEMORY_POOL_L0, 0, 0};
    D3D12_RESOURCE_DESC desc = CD3DX12_RESOURCE_DESC::Buffer(16);
    desc.Flags = D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS;
    ComPtr<ID3D12Resource> words;
    ASSERT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                               D3D12_RESOURCE_STATE_COMMON, nullptr,
                                               IID_PPV_ARGS(words.GetAddressOf())),
              S_OK);
    ComPtr<ID3D12GraphicsCommandList2> list2;
    ASSERT_EQ(list_.As(&list2), S_OK);
    const D3D12_WRITEBUFFERIMMEDIATE_PARAMETER value = {words->GetGPUVirtualAddress() + 4, 5};
    list2->WriteBufferImmediate(1, &value, nullptr);
    EXPECT_EQ(read(words.Get(), 2), (std::vector<uint32_t>{0, 5}));
    void* mapped = nullptr;
    ASSERT_EQ(words->Map(0, nullptr, &mapped), S_OK);
    EXPECT_EQ(static_cast<const uint32_t*>(mapped)[1], 5u);
  }
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

// Mip m of a texture holds m + 1. A minimum level of detail counts the texture's mips.
TEST_P(RuntimeRules, ViewsReadNoMipBelowTheirMinimum) {
  const auto texture = mip_texture(3);
  struct Case {
    UINT first_mip, mips;
    float clamp, load_mip, lod;
    float loaded, sampled;
    bool any_backend;  // else lavapipe ignores the clamp
  };
  const Case cases[] = {
      {0, 3, 0, 0, 0, 1, 1, true},          {0, 3, 1, 1, 0, 2, 2, false},
      {0, 3, 1, 0, 2, 0, 3, false},         {1, 2, 1, 0, 0, 2, 2, true},
      {1, 2, 2, 0, 0, 0, 3, false},         {0, 3, 1.9f, 1, 0, 2, 3, false},
      {0, 2, 1.1f, 1, 1, 0, 0, true},       {0, 3, 9, 2, 2, 0, 0, true},
      {0, 1, 1 / 512.0f, 0, 0, 0, 0, true}, {0, 1, 1 / 1024.0f, 0, 0, 1, 1, true},
  };
  for (const Case& c : cases) {
    if (!c.any_backend && std::string(GetParam()) == "vulkan") continue;
    D3D12_SHADER_RESOURCE_VIEW_DESC view = {};
    view.Format = DXGI_FORMAT_R32_FLOAT;
    view.ViewDimension = D3D12_SRV_DIMENSION_TEXTURE2D;
    view.Shader4ComponentMapping = D3D12_DEFAULT_SHADER_4_COMPONENT_MAPPING;
    view.Texture2D = {c.first_mip, c.mips, 0, c.clamp};
    const auto [loaded, sampled] = read_mips(texture.Get(), view, c.load_mip, c.lod);
    EXPECT_EQ(loaded, c.loaded) << c.first_mip << " + " << c.mips << ", clamp " << c.clamp;
    EXPECT_EQ(sampled, c.sampled) << c.first_mip << " + " << c.mips << ", clamp " << c.clamp;
  }
  EXPECT_TRUE(messages().empty());
}

// Buffers have no layout, so that a flag says what they hold. [D3D12: enhanced barriers]
TEST_P(RuntimeRules, AFlagMakesABufferOfAccelerationStructures) {
  ComPtr<ID3D12Device10> device;
  ASSERT_EQ(device_.As(&device), S_OK);
  D3D12_HEAP_PROPERTIES heap = {};
  heap.Type = D3D12_HEAP_TYPE_DEFAULT;
  D3D12_RESOURCE_DESC1 desc = {};
  desc.Dimension = D3D12_RESOURCE_DIMENSION_BUFFER;
  desc.Width = 65536;
  desc.Height = desc.DepthOrArraySize = desc.MipLevels = 1;
  desc.SampleDesc.Count = 1;
  desc.Layout = D3D12_TEXTURE_LAYOUT_ROW_MAJOR;
  desc.Flags = D3D12_RESOURCE_FLAG_RAYTRACING_ACCELERATION_STRUCTURE;
  ComPtr<ID3D12Resource> structure;
  const auto create = [&] {
    return device->CreateCommittedResource3(
        &heap, D3D12_HEAP_FLAG_NONE, &desc, D3D12_BARRIER_LAYOUT_UNDEFINED, nullptr, nullptr, 0,
        nullptr, IID_PPV_ARGS(structure.ReleaseAndGetAddressOf()));
  };
  EXPECT_EQ(create(), E_INVALIDARG) << "without ALLOW_UNORDERED_ACCESS";
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA4011");
  desc.Flags |= D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS;
  ASSERT_EQ(create(), S_OK);
  EXPECT_EQ(structure->GetDesc().Flags, desc.Flags);
  const auto scratch = buffer(65536, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_COMMON,
                              D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC build = {};
  build.Inputs.Type = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL;
  build.Inputs.DescsLayout = D3D12_ELEMENTS_LAYOUT_ARRAY;  // of no instances
  build.DestAccelerationStructureData = structure->GetGPUVirtualAddress();
  build.ScratchAccelerationStructureData = scratch->GetGPUVirtualAddress();
  list_->BuildRaytracingAccelerationStructure(&build, 0, nullptr);
  run();
  EXPECT_EQ(messages().size(), 1u);
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
