// SPDX-License-Identifier: MIT
// Devices, resources, heaps, descriptors and features.
#include <rtapi/rtapi.h>

#include <algorithm>
#include <cstring>

#include "d3d12/objects/d3d12_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::d3d12 {
namespace {

class DeviceCalls : public D3d12Test {};

TEST_F(DeviceCalls, ANullPointerOnlyAsksWhetherADeviceCouldBeMade) {
  EXPECT_EQ(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_11_0, __uuidof(ID3D12Device), nullptr),
            S_FALSE);
  ID3D12Device* device = nullptr;
  EXPECT_EQ(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_2, IID_PPV_ARGS(&device)),
            DXGI_ERROR_UNSUPPORTED);
  EXPECT_EQ(device, nullptr);
}

TEST_F(DeviceCalls, TheNewestVersionIsThereAndWhatItMadeKnowsIt) {
  ComPtr<ID3D12Device11> newest;
  ASSERT_EQ(device_.As(&newest), S_OK);
  ComPtr<ID3D12Device> of_list;
  ASSERT_EQ(list_->GetDevice(IID_PPV_ARGS(of_list.GetAddressOf())), S_OK);
  ComPtr<IUnknown> a, b;
  device_.As(&a);
  of_list.As(&b);
  EXPECT_EQ(a.Get(), b.Get());
}

TEST_F(DeviceCalls, WhatItMadeKeepsTheDeviceAlive) {
  ComPtr<ID3D12Fence> fence;
  {
    ComPtr<ID3D12Device> other;
    ASSERT_EQ(
        D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(other.GetAddressOf())),
        S_OK);
    ASSERT_EQ(other->CreateFence(5, D3D12_FENCE_FLAG_NONE, IID_PPV_ARGS(fence.GetAddressOf())),
              S_OK);
  }
  ComPtr<ID3D12Device> device;
  ASSERT_EQ(fence->GetDevice(IID_PPV_ARGS(device.GetAddressOf())), S_OK);
  EXPECT_EQ(device->GetNodeCount(), 1u);
  EXPECT_EQ(fence->GetCompletedValue(), 5u);
}

TEST_F(DeviceCalls, AnUploadBufferIsMappedAndADefaultOneIsNot) {
  const auto upload = buffer(256, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  void* bytes = nullptr;
  ASSERT_EQ(upload->Map(0, nullptr, &bytes), S_OK);
  ASSERT_NE(bytes, nullptr);
  upload->Unmap(0, nullptr);
  EXPECT_NE(upload->GetGPUVirtualAddress(), 0u);
  EXPECT_EQ(upload->Map(1, nullptr, &bytes), E_INVALIDARG);
  EXPECT_NE(bytes, nullptr);  // not touched
  EXPECT_FALSE(SUCCEEDED(buffer(256, D3D12_HEAP_TYPE_DEFAULT)->Map(0, nullptr, &bytes)));
  ASSERT_EQ(messages().size(), 2u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA4012");
  EXPECT_EQ(messages()[1].substr(0, 6), "KA0911");
}

TEST_F(DeviceCalls, ABufferDescWithATexturesMembersIsRefused) {
  D3D12_HEAP_PROPERTIES heap = {};
  heap.Type = D3D12_HEAP_TYPE_DEFAULT;
  D3D12_RESOURCE_DESC desc = {};
  desc.Dimension = D3D12_RESOURCE_DIMENSION_BUFFER;
  desc.Width = 64;
  ID3D12Resource* resource = nullptr;
  EXPECT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                             D3D12_RESOURCE_STATE_COMMON, nullptr,
                                             IID_PPV_ARGS(&resource)),
            E_INVALIDARG);
  EXPECT_EQ(resource, nullptr);
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA4011");
}

D3D12_RESOURCE_DESC texture(UINT width, UINT height, DXGI_FORMAT format, UINT16 mips) {
  D3D12_RESOURCE_DESC desc = {};
  desc.Dimension = D3D12_RESOURCE_DIMENSION_TEXTURE2D;
  desc.Width = width;
  desc.Height = height;
  desc.DepthOrArraySize = 1;
  desc.MipLevels = mips;
  desc.Format = format;
  desc.SampleDesc.Count = 1;
  return desc;
}

TEST_F(DeviceCalls, ATextureOfAllMipsTellsHowManyItHas) {
  D3D12_HEAP_PROPERTIES heap = {};
  heap.Type = D3D12_HEAP_TYPE_DEFAULT;
  const D3D12_RESOURCE_DESC desc = texture(20, 8, DXGI_FORMAT_R8G8B8A8_UNORM, 0);
  ComPtr<ID3D12Resource2> resource;
  ASSERT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                             D3D12_RESOURCE_STATE_COPY_DEST, nullptr,
                                             IID_PPV_ARGS(resource.GetAddressOf())),
            S_OK);
  EXPECT_EQ(resource->GetDesc().MipLevels, 5);  // 20, 10, 5, 2, 1
  EXPECT_EQ(resource->GetDesc1().Width, 20u);
  EXPECT_EQ(resource->GetGPUVirtualAddress(), 0u);
  D3D12_HEAP_PROPERTIES told;
  D3D12_HEAP_FLAGS flags;
  ASSERT_EQ(resource->GetHeapProperties(&told, &flags), S_OK);
  EXPECT_EQ(told.Type, D3D12_HEAP_TYPE_DEFAULT);
}

// 20 x 8 texels of 4 bytes: rows of 80 bytes at multiples of 256.
TEST_F(DeviceCalls, FootprintsAreD3D12s) {
  const D3D12_RESOURCE_DESC desc = texture(20, 8, DXGI_FORMAT_R8G8B8A8_UNORM, 2);
  D3D12_PLACED_SUBRESOURCE_FOOTPRINT layouts[2];
  UINT rows[2];
  UINT64 row_bytes[2], total;
  device_->GetCopyableFootprints(&desc, 0, 2, 0, layouts, rows, row_bytes, &total);
  EXPECT_EQ(layouts[0].Footprint.RowPitch, 256u);
  EXPECT_EQ(rows[0], 8u);
  EXPECT_EQ(row_bytes[0], 80u);
  EXPECT_EQ(layouts[1].Offset, 2048u);
  EXPECT_EQ(layouts[1].Footprint.Width, 10u);
  EXPECT_EQ(total, 2048 + 3 * 256 + 40u);
  device_->GetCopyableFootprints(&desc, 1, 2, 0, layouts, rows, row_bytes, &total);
  EXPECT_EQ(total, UINT64_MAX);
  EXPECT_EQ(rows[0], UINT_MAX);
}

TEST_F(DeviceCalls, PlacedResourcesLieInsideTheirHeap) {
  D3D12_HEAP_DESC heap_desc = {};
  heap_desc.SizeInBytes = 131072;
  heap_desc.Properties.Type = D3D12_HEAP_TYPE_UPLOAD;
  ComPtr<ID3D12Heap> heap;
  ASSERT_EQ(device_->CreateHeap(&heap_desc, IID_PPV_ARGS(heap.GetAddressOf())), S_OK);
  EXPECT_EQ(heap->GetDesc().Alignment, 65536u);
  const D3D12_RESOURCE_DESC desc =
      buffer(70000, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ)->GetDesc();
  const D3D12_RESOURCE_ALLOCATION_INFO info = device_->GetResourceAllocationInfo(0, 1, &desc);
  EXPECT_EQ(info.SizeInBytes, 131072u);
  EXPECT_EQ(info.Alignment, 65536u);
  ComPtr<ID3D12Resource> placed;
  ASSERT_EQ(device_->CreatePlacedResource(heap.Get(), 0, &desc, D3D12_RESOURCE_STATE_GENERIC_READ,
                                          nullptr, IID_PPV_ARGS(placed.GetAddressOf())),
            S_OK);
  void* bytes = nullptr;
  EXPECT_EQ(placed->Map(0, nullptr, &bytes), S_OK);
  EXPECT_EQ(
      device_->CreatePlacedResource(heap.Get(), 65536, &desc, D3D12_RESOURCE_STATE_GENERIC_READ,
                                    nullptr, IID_PPV_ARGS(placed.ReleaseAndGetAddressOf())),
      E_INVALIDARG);
  EXPECT_NE(messages().back().find("is placed at byte 65536"), std::string::npos)
      << messages().back();
}

TEST_F(DeviceCalls, ViewsThatCannotBeAreReported) {
  D3D12_DESCRIPTOR_HEAP_DESC heap_desc = {};
  heap_desc.Type = D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV;
  heap_desc.NumDescriptors = 4;
  ComPtr<ID3D12DescriptorHeap> heap;
  ASSERT_EQ(device_->CreateDescriptorHeap(&heap_desc, IID_PPV_ARGS(heap.GetAddressOf())), S_OK);
  EXPECT_EQ(heap->GetDesc().NumDescriptors, 4u);
  EXPECT_EQ(heap->GetGPUDescriptorHandleForHeapStart().ptr, 0u);  // shaders cannot see it
  const auto data = buffer(256, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  D3D12_SHADER_RESOURCE_VIEW_DESC view = {};
  view.ViewDimension = D3D12_SRV_DIMENSION_BUFFER;
  view.Shader4ComponentMapping = D3D12_DEFAULT_SHADER_4_COMPONENT_MAPPING;
  view.Buffer.NumElements = 16;
  view.Buffer.StructureByteStride = 16;
  device_->CreateShaderResourceView(data.Get(), &view, heap->GetCPUDescriptorHandleForHeapStart());
  EXPECT_TRUE(messages().empty());
  view.Buffer.NumElements = 17;
  device_->CreateShaderResourceView(data.Get(), &view, heap->GetCPUDescriptorHandleForHeapStart());
  view.ViewDimension = D3D12_SRV_DIMENSION_TEXTURE2DMS;
  device_->CreateShaderResourceView(data.Get(), &view, heap->GetCPUDescriptorHandleForHeapStart());
  view.ViewDimension = D3D12_SRV_DIMENSION_UNKNOWN;
  device_->CreateShaderResourceView(data.Get(), &view, heap->GetCPUDescriptorHandleForHeapStart());
  ASSERT_EQ(messages().size(), 3u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA0624");
  EXPECT_EQ(messages()[1].substr(0, 6), "KA0623");
  EXPECT_EQ(messages()[2].substr(0, 6), "KA4013");
}

// Ranges {2, 1} into {1, 2}: descriptors 0, 1, 2 arrive in order.
TEST_F(DeviceCalls, CopyDescriptorsSplitsRanges) {
  D3D12_DESCRIPTOR_HEAP_DESC heap_desc = {};
  heap_desc.Type = D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER;
  heap_desc.NumDescriptors = 8;
  ComPtr<ID3D12DescriptorHeap> heap;
  ASSERT_EQ(device_->CreateDescriptorHeap(&heap_desc, IID_PPV_ARGS(heap.GetAddressOf())), S_OK);
  const SIZE_T start = heap->GetCPUDescriptorHandleForHeapStart().ptr;
  const UINT step = device_->GetDescriptorHandleIncrementSize(D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER);
  const D3D12_CPU_DESCRIPTOR_HANDLE from[] = {{start}, {start + 2 * step}};
  const D3D12_CPU_DESCRIPTOR_HANDLE to[] = {{start + 4 * step}, {start + 6 * step}};
  const UINT from_sizes[] = {2, 1}, to_sizes[] = {1, 2};
  device_->CopyDescriptors(2, to, to_sizes, 2, from, from_sizes,
                           D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER);
  EXPECT_TRUE(messages().empty());
  device_->CopyDescriptors(2, to, to_sizes, 1, from, from_sizes,
                           D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER);
  EXPECT_TRUE(messages().empty());  // a warning: the smaller total is copied
}

TEST_F(DeviceCalls, FeaturesAreWhatRtapiHas) {
  D3D12_FEATURE_DATA_D3D12_OPTIONS5 five = {};
  ASSERT_EQ(device_->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS5, &five, sizeof(five)), S_OK);
  EXPECT_EQ(five.RaytracingTier, static_cast<D3D12_RAYTRACING_TIER>(12));  // not in the headers
  D3D12_FEATURE_DATA_D3D12_OPTIONS7 seven = {};
  ASSERT_EQ(device_->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS7, &seven, sizeof(seven)),
            S_OK);
  EXPECT_EQ(seven.MeshShaderTier, D3D12_MESH_SHADER_TIER_NOT_SUPPORTED);
  D3D12_FEATURE_DATA_SHADER_MODEL model = {static_cast<D3D_SHADER_MODEL>(0x6A)};
  ASSERT_EQ(device_->CheckFeatureSupport(D3D12_FEATURE_SHADER_MODEL, &model, sizeof(model)), S_OK);
  EXPECT_EQ(model.HighestShaderModel, static_cast<D3D_SHADER_MODEL>(rtapi::kHighestShaderModel));
  model.HighestShaderModel = D3D_SHADER_MODEL_6_5;  // what the program knows
  ASSERT_EQ(device_->CheckFeatureSupport(D3D12_FEATURE_SHADER_MODEL, &model, sizeof(model)), S_OK);
  EXPECT_EQ(model.HighestShaderModel, D3D_SHADER_MODEL_6_5);
  const D3D_FEATURE_LEVEL levels[] = {D3D_FEATURE_LEVEL_12_2, D3D_FEATURE_LEVEL_12_1,
                                      D3D_FEATURE_LEVEL_11_0};
  D3D12_FEATURE_DATA_FEATURE_LEVELS level = {3, levels, {}};
  ASSERT_EQ(device_->CheckFeatureSupport(D3D12_FEATURE_FEATURE_LEVELS, &level, sizeof(level)),
            S_OK);
  EXPECT_EQ(level.MaxSupportedFeatureLevel, D3D_FEATURE_LEVEL_12_1);
  EXPECT_EQ(device_->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS5, &five, 1), E_INVALIDARG);
  EXPECT_EQ(device_->CheckFeatureSupport(static_cast<D3D12_FEATURE>(999), &five, sizeof(five)),
            E_INVALIDARG);
}

// A device of the level that the two variables ask for; null if there is none.
ComPtr<ID3D12Device> device_of_level(const char* tier, const char* model) {
  setenv("KAAMOS_RAYTRACING_TIER", tier, 1);
  setenv("KAAMOS_SHADER_MODEL", model, 1);
  ComPtr<ID3D12Device> device;
  D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(device.GetAddressOf()));
  unsetenv("KAAMOS_RAYTRACING_TIER");
  unsetenv("KAAMOS_SHADER_MODEL");
  return device;
}

TEST_F(DeviceCalls, VulkanHasTheSameTier) {
  KAAMOS_NEED_VULKAN();
  setenv("KAAMOS_BACKEND", "vulkan", 1);
  ComPtr<ID3D12Device> device;
  D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(device.GetAddressOf()));
  unsetenv("KAAMOS_BACKEND");
  ASSERT_NE(device, nullptr);
  D3D12_FEATURE_DATA_D3D12_OPTIONS5 five = {};
  ASSERT_EQ(device->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS5, &five, sizeof(five)), S_OK);
  EXPECT_EQ(five.RaytracingTier, static_cast<D3D12_RAYTRACING_TIER>(12));
  EXPECT_TRUE(messages().empty());
}

TEST_F(DeviceCalls, VariablesChooseTheLevel) {
  struct Row {
    const char* tier;
    const char* model;
    D3D12_RAYTRACING_TIER reported;
    D3D_SHADER_MODEL reported_model;
  };
  for (const Row& row :
       {Row{"none", "6.0", D3D12_RAYTRACING_TIER_NOT_SUPPORTED, D3D_SHADER_MODEL_6_0},
        Row{"1.0", "6.3", D3D12_RAYTRACING_TIER_1_0, D3D_SHADER_MODEL_6_3},
        Row{"1.1", "6.5", D3D12_RAYTRACING_TIER_1_1, D3D_SHADER_MODEL_6_5},
        Row{"1.1", "6.10", D3D12_RAYTRACING_TIER_1_1, static_cast<D3D_SHADER_MODEL>(0x6A)}}) {
    const auto device = device_of_level(row.tier, row.model);
    ASSERT_NE(device, nullptr) << row.tier;
    D3D12_FEATURE_DATA_D3D12_OPTIONS5 five = {};
    EXPECT_EQ(device->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS5, &five, sizeof(five)), S_OK);
    EXPECT_EQ(five.RaytracingTier, row.reported) << row.tier;
    D3D12_FEATURE_DATA_SHADER_MODEL model = {static_cast<D3D_SHADER_MODEL>(0x6A)};
    EXPECT_EQ(device->CheckFeatureSupport(D3D12_FEATURE_SHADER_MODEL, &model, sizeof(model)), S_OK);
    EXPECT_EQ(model.HighestShaderModel, row.reported_model) << row.tier;
  }
  Listener listener;
  const Quiet quiet;
  EXPECT_EQ(device_of_level("1.1", "6.4"), nullptr);  // the tier needs 6.5
  EXPECT_EQ(device_of_level("1.5", "6.5"), nullptr);
  EXPECT_EQ(device_of_level("1.1", "7"), nullptr);
  ASSERT_EQ(listener.messages.size(), 3u);
  for (const std::string& message : listener.messages) EXPECT_EQ(message.substr(0, 6), "KA0914");
}

TEST_F(DeviceCalls, FeaturesOfNewerHeadersAreAnswered) {
  const auto ask = [this](D3D12_FEATURE feature, auto& data) {
    return device_->CheckFeatureSupport(feature, &data, sizeof(data));
  };
  D3D12_FEATURE_DATA_D3D12_OPTIONS16 depth_bias = {TRUE, TRUE};
  ASSERT_EQ(ask(D3D12_FEATURE_D3D12_OPTIONS16, depth_bias), S_OK);
  EXPECT_FALSE(depth_bias.GPUUploadHeapSupported);
  D3D12_FEATURE_DATA_D3D12_OPTIONS19 heaps = {};
  ASSERT_EQ(ask(D3D12_FEATURE_D3D12_OPTIONS19, heaps), S_OK);
  EXPECT_EQ(heaps.MaxSamplerDescriptorHeapSize, 2048u);
  D3D12_FEATURE_DATA_D3D12_OPTIONS21 indirect = {};
  ASSERT_EQ(ask(D3D12_FEATURE_D3D12_OPTIONS21, indirect), S_OK);
  EXPECT_EQ(indirect.ExecuteIndirectTier, D3D12_EXECUTE_INDIRECT_TIER_1_0);
  D3D12_FEATURE_DATA_TIGHT_ALIGNMENT alignment = {D3D12_TIGHT_ALIGNMENT_TIER_1};
  ASSERT_EQ(ask(D3D12_FEATURE_D3D12_TIGHT_ALIGNMENT, alignment), S_OK);
  EXPECT_EQ(alignment.SupportTier, D3D12_TIGHT_ALIGNMENT_TIER_NOT_SUPPORTED);
  D3D12_FEATURE_DATA_D3D12_OPTIONS22 reorder = {TRUE, TRUE, 1, 1};
  ASSERT_EQ(ask(D3D12_FEATURE_D3D12_OPTIONS22, reorder), S_OK);
  EXPECT_FALSE(reorder.ShaderExecutionReorderingActuallyReorders);
  EXPECT_EQ(reorder.Max1DDispatchSize, 65535u);
  EXPECT_EQ(ask(D3D12_FEATURE_D3D12_OPTIONS22, indirect.WorkGraphsTier),
            E_INVALIDARG);  // too small
}

TEST_F(DeviceCalls, FormatsSupportWhatCanBeMade) {
  const auto support = [&](DXGI_FORMAT format) {
    D3D12_FEATURE_DATA_FORMAT_SUPPORT data = {format, {}, {}};
    EXPECT_EQ(device_->CheckFeatureSupport(D3D12_FEATURE_FORMAT_SUPPORT, &data, sizeof(data)),
              S_OK);
    return data;
  };
  const auto rgba8 = support(DXGI_FORMAT_R8G8B8A8_UNORM);
  EXPECT_NE(rgba8.Support1 & D3D12_FORMAT_SUPPORT1_RENDER_TARGET, 0);
  EXPECT_NE(rgba8.Support1 & D3D12_FORMAT_SUPPORT1_SHADER_SAMPLE, 0);
  EXPECT_NE(rgba8.Support2 & D3D12_FORMAT_SUPPORT2_UAV_TYPED_LOAD, 0);
  EXPECT_EQ(rgba8.Support1 & D3D12_FORMAT_SUPPORT1_DEPTH_STENCIL, 0);
  EXPECT_EQ(rgba8.Support2 & D3D12_FORMAT_SUPPORT2_OUTPUT_MERGER_LOGIC_OP, 0);
  const auto uint8 = support(DXGI_FORMAT_R8G8B8A8_UINT);
  EXPECT_NE(uint8.Support2 & D3D12_FORMAT_SUPPORT2_OUTPUT_MERGER_LOGIC_OP, 0);
  const auto bc7 = support(DXGI_FORMAT_BC7_UNORM);
  EXPECT_NE(bc7.Support1 & D3D12_FORMAT_SUPPORT1_TEXTURE2D, 0);
  EXPECT_EQ(bc7.Support1 & D3D12_FORMAT_SUPPORT1_TYPED_UNORDERED_ACCESS_VIEW, 0);
  const auto depth = support(DXGI_FORMAT_D32_FLOAT);
  EXPECT_NE(depth.Support1 & D3D12_FORMAT_SUPPORT1_DEPTH_STENCIL, 0);
  EXPECT_EQ(support(DXGI_FORMAT_NV12).Support1, D3D12_FORMAT_SUPPORT1_NONE);
  EXPECT_TRUE(messages().empty());  // a probe that fails is no error
}

TEST_F(DeviceCalls, TheDebugLayersInterfacesNeedTheDebugLayer) {
  ComPtr<ID3D12InfoQueue> queue;
  EXPECT_EQ(device_.As(&queue), E_NOINTERFACE);
  ComPtr<ID3D12Debug4> debug;
  ASSERT_EQ(D3D12GetDebugInterface(IID_PPV_ARGS(debug.GetAddressOf())), S_OK);
  debug->EnableDebugLayer();
  ComPtr<ID3D12Device> checked;
  EXPECT_EQ(
      D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(checked.GetAddressOf())),
      S_OK);
  debug->DisableDebugLayer();
  EXPECT_EQ(checked.As(&queue), S_OK);
  ComPtr<ID3D12DebugDevice> debug_device;
  EXPECT_EQ(checked.As(&debug_device), S_OK);
}

TEST_F(DeviceCalls, ARemovedDeviceSaysSo) {
  EXPECT_EQ(device_->GetDeviceRemovedReason(), S_OK);
  device_->RemoveDevice();
  EXPECT_EQ(device_->GetDeviceRemovedReason(), DXGI_ERROR_DEVICE_REMOVED);
  ComPtr<ID3D12CommandQueue> queue;
  const D3D12_COMMAND_QUEUE_DESC desc = {};
  EXPECT_EQ(device_->CreateCommandQueue(&desc, IID_PPV_ARGS(queue.GetAddressOf())),
            DXGI_ERROR_DEVICE_REMOVED);
}

// [D3D12: ID3D12DeviceRemovedExtendedData]
TEST_F(DeviceCalls, RemovedDataIsThereOnceTheDeviceIsRemoved) {
  ComPtr<ID3D12DeviceRemovedExtendedDataSettings1> settings;
  ASSERT_EQ(D3D12GetDebugInterface(IID_PPV_ARGS(settings.GetAddressOf())), S_OK);
  settings->SetAutoBreadcrumbsEnablement(D3D12_DRED_ENABLEMENT_FORCED_ON);
  ComPtr<ID3D12Device5> asked;
  ASSERT_EQ(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(asked.GetAddressOf())),
            S_OK);
  settings->SetAutoBreadcrumbsEnablement(D3D12_DRED_ENABLEMENT_SYSTEM_CONTROLLED);
  ComPtr<ID3D12DeviceRemovedExtendedData2> data;
  ASSERT_EQ(asked.As(&data), S_OK);
  D3D12_DRED_AUTO_BREADCRUMBS_OUTPUT breadcrumbs = {};
  EXPECT_EQ(data->GetAutoBreadcrumbsOutput(&breadcrumbs), DXGI_ERROR_NOT_CURRENTLY_AVAILABLE);
  EXPECT_EQ(data->GetDeviceState(), D3D12_DRED_DEVICE_STATE_UNKNOWN);
  asked->RemoveDevice();
  breadcrumbs.pHeadAutoBreadcrumbNode = reinterpret_cast<D3D12_AUTO_BREADCRUMB_NODE*>(1);
  EXPECT_EQ(data->GetAutoBreadcrumbsOutput(&breadcrumbs), S_OK);
  EXPECT_EQ(breadcrumbs.pHeadAutoBreadcrumbNode, nullptr);
  D3D12_DRED_PAGE_FAULT_OUTPUT fault = {};
  EXPECT_EQ(data->GetPageFaultAllocationOutput(&fault), DXGI_ERROR_UNSUPPORTED);
  EXPECT_EQ(data->GetPageFaultAllocationOutput(nullptr), E_INVALIDARG);
  EXPECT_EQ(data->GetDeviceState(), D3D12_DRED_DEVICE_STATE_FAULT);
}

TEST_F(DeviceCalls, TheClearValueOfADepthTextureIsItsDepth) {
  ComPtr<ID3D12Debug4> debug;
  ASSERT_EQ(D3D12GetDebugInterface(IID_PPV_ARGS(debug.GetAddressOf())), S_OK);
  debug->EnableDebugLayer();
  ComPtr<ID3D12Device> checked;
  ASSERT_EQ(
      D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(checked.GetAddressOf())),
      S_OK);
  debug->DisableDebugLayer();
  D3D12_HEAP_PROPERTIES heap = {};
  heap.Type = D3D12_HEAP_TYPE_DEFAULT;
  D3D12_RESOURCE_DESC desc = {};
  desc.Dimension = D3D12_RESOURCE_DIMENSION_TEXTURE2D;
  desc.Width = desc.Height = 8;
  desc.DepthOrArraySize = desc.MipLevels = 1;
  desc.Format = DXGI_FORMAT_D32_FLOAT;
  desc.SampleDesc.Count = 1;
  desc.Flags = D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL;
  D3D12_CLEAR_VALUE clear = {};
  clear.Format = DXGI_FORMAT_D32_FLOAT;
  clear.DepthStencil.Depth = 1;
  ComPtr<ID3D12Resource> depth;
  ASSERT_EQ(checked->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                             D3D12_RESOURCE_STATE_DEPTH_WRITE, &clear,
                                             IID_PPV_ARGS(depth.GetAddressOf())),
            S_OK);
  D3D12_DESCRIPTOR_HEAP_DESC views = {D3D12_DESCRIPTOR_HEAP_TYPE_DSV, 1,
                                      D3D12_DESCRIPTOR_HEAP_FLAG_NONE, 0};
  ComPtr<ID3D12DescriptorHeap> view;
  ASSERT_EQ(checked->CreateDescriptorHeap(&views, IID_PPV_ARGS(view.GetAddressOf())), S_OK);
  checked->CreateDepthStencilView(depth.Get(), nullptr, view->GetCPUDescriptorHandleForHeapStart());
  D3D12_COMMAND_QUEUE_DESC queue_desc = {};
  ComPtr<ID3D12CommandQueue> queue;
  ASSERT_EQ(checked->CreateCommandQueue(&queue_desc, IID_PPV_ARGS(queue.GetAddressOf())), S_OK);
  ComPtr<ID3D12CommandAllocator> allocator;
  ASSERT_EQ(checked->CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE_DIRECT,
                                            IID_PPV_ARGS(allocator.GetAddressOf())),
            S_OK);
  ComPtr<ID3D12GraphicsCommandList> list;
  ASSERT_EQ(checked->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_DIRECT, allocator.Get(), nullptr,
                                       IID_PPV_ARGS(list.GetAddressOf())),
            S_OK);
  list->ClearDepthStencilView(view->GetCPUDescriptorHandleForHeapStart(), D3D12_CLEAR_FLAG_DEPTH, 1,
                              0, 0, nullptr);
  ASSERT_EQ(list->Close(), S_OK);
  ComPtr<ID3D12InfoQueue> info;
  ASSERT_EQ(checked.As(&info), S_OK);
  ID3D12CommandList* lists[] = {list.Get()};
  queue->ExecuteCommandLists(1, lists);
  UINT64 gpu = 0, cpu = 0;
  EXPECT_EQ(queue->GetClockCalibration(&gpu, &cpu), S_OK);
  ComPtr<ID3D12Fence> fence;
  ASSERT_EQ(checked->CreateFence(0, D3D12_FENCE_FLAG_NONE, IID_PPV_ARGS(fence.GetAddressOf())),
            S_OK);
  ASSERT_EQ(queue->Signal(fence.Get(), 1), S_OK);
  ASSERT_EQ(fence->SetEventOnCompletion(1, nullptr), S_OK);
  EXPECT_EQ(info->GetNumStoredMessages(), 0u);  // no KA0477
}

}  // namespace
}  // namespace kaamos::d3d12
