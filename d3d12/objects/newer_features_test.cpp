// SPDX-License-Identifier: MIT
// What d3d12/include declares of newer headers: against rtapi and the features that devices answer,
// and against Microsoft's own where KAAMOS_D3D12_HEADERS names headers that have them.
#include <rtapi/rtapi.h>

#include <gtest/gtest.h>
#include <windows.h>

#include <directx/d3d12.h>
#include <dxguids/dxguids.h>
#include <kaamos_d3d12_interfaces.h>

// All of them, beside those of a newer d3d12.h.
namespace ours {
#define KAAMOS_D3D12_HEADER_VERSION 606
#include <kaamos_d3d12_newer.h>
#undef KAAMOS_D3D12_HEADER_VERSION
}  // namespace ours

#include "d3d12/objects/newer_features.h"

namespace kaamos::d3d12 {
namespace {

using newer::Feature;

Feature feature(D3D12_FEATURE value) {
  return static_cast<Feature>(static_cast<UINT>(value));
}

TEST(NewerFeatures, InterfacesHaveTheirIds) {
  EXPECT_TRUE(IID_ID3D12Device14 == __uuidof(ID3D12Device14));
  EXPECT_TRUE(IID_ID3D12Device13 == __uuidof(ID3D12Device13));
  EXPECT_TRUE(IID_ID3D12Device12 == __uuidof(ID3D12Device12));
  EXPECT_TRUE(IID_ID3D12GraphicsCommandList9 == __uuidof(ID3D12GraphicsCommandList9));
}

TEST(NewerFeatures, HaveTheNumbersThatDevicesAnswer) {
  EXPECT_EQ(feature(ours::D3D12_FEATURE_D3D12_OPTIONS16), Feature::kOptions16);
  EXPECT_EQ(feature(ours::D3D12_FEATURE_D3D12_OPTIONS17), Feature::kOptions17);
  EXPECT_EQ(feature(ours::D3D12_FEATURE_D3D12_OPTIONS18), Feature::kOptions18);
  EXPECT_EQ(feature(ours::D3D12_FEATURE_D3D12_OPTIONS19), Feature::kOptions19);
  EXPECT_EQ(feature(ours::D3D12_FEATURE_D3D12_OPTIONS20), Feature::kOptions20);
  EXPECT_EQ(feature(ours::D3D12_FEATURE_PREDICATION), Feature::kPredication);
  EXPECT_EQ(feature(ours::D3D12_FEATURE_HARDWARE_COPY), Feature::kHardwareCopy);
  EXPECT_EQ(feature(ours::D3D12_FEATURE_D3D12_OPTIONS21), Feature::kOptions21);
  EXPECT_EQ(feature(ours::D3D12_FEATURE_D3D12_TIGHT_ALIGNMENT), Feature::kTightAlignment);
  EXPECT_EQ(feature(ours::D3D12_FEATURE_D3D12_OPTIONS22), Feature::kOptions22);
  EXPECT_EQ(static_cast<int>(ours::D3D_SHADER_MODEL_6_9),
            static_cast<int>(rtapi::ShaderModel::k6_9));
  EXPECT_EQ(static_cast<int>(ours::D3D12_RAYTRACING_TIER_1_2),
            static_cast<int>(rtapi::RaytracingTier::kTier1_2));
}

#if D3D12_SDK_VERSION >= 619
TEST(NewerFeatures, AgreeWithMicrosoftsHeaders) {
  // All members are of 4 bytes, so that sizes and the last offsets decide.
#define KAAMOS_SAME_VALUE(name) EXPECT_EQ(static_cast<int>(ours::name), static_cast<int>(::name))
#define KAAMOS_SAME_LAST(type, last)                   \
  static_assert(sizeof(ours::type) == sizeof(::type)); \
  static_assert(offsetof(ours::type, last) == offsetof(::type, last))
  KAAMOS_SAME_VALUE(D3D12_FEATURE_D3D12_OPTIONS16);
  KAAMOS_SAME_VALUE(D3D12_FEATURE_D3D12_OPTIONS17);
  KAAMOS_SAME_VALUE(D3D12_FEATURE_D3D12_OPTIONS18);
  KAAMOS_SAME_VALUE(D3D12_FEATURE_D3D12_OPTIONS19);
  KAAMOS_SAME_VALUE(D3D12_FEATURE_D3D12_OPTIONS20);
  KAAMOS_SAME_VALUE(D3D12_FEATURE_PREDICATION);
  KAAMOS_SAME_VALUE(D3D12_FEATURE_HARDWARE_COPY);
  KAAMOS_SAME_VALUE(D3D12_FEATURE_D3D12_OPTIONS21);
  KAAMOS_SAME_VALUE(D3D12_FEATURE_D3D12_TIGHT_ALIGNMENT);
  KAAMOS_SAME_VALUE(D3D12_FEATURE_D3D12_OPTIONS22);
  KAAMOS_SAME_VALUE(D3D12_HEAP_TYPE_GPU_UPLOAD);
  KAAMOS_SAME_VALUE(D3D12_RECREATE_AT_TIER_1);
  KAAMOS_SAME_VALUE(D3D_SHADER_MODEL_6_9);
  KAAMOS_SAME_VALUE(D3D12_WORK_GRAPHS_TIER_1_0);
  KAAMOS_SAME_VALUE(D3D12_EXECUTE_INDIRECT_TIER_1_0);
  KAAMOS_SAME_VALUE(D3D12_EXECUTE_INDIRECT_TIER_1_1);
  KAAMOS_SAME_VALUE(D3D12_RAYTRACING_TIER_1_2);
  KAAMOS_SAME_VALUE(D3D12_TIGHT_ALIGNMENT_TIER_1);
  KAAMOS_SAME_VALUE(D3D12_RESOURCE_FLAG_USE_TIGHT_ALIGNMENT);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_D3D12_OPTIONS16, GPUUploadHeapSupported);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_D3D12_OPTIONS17, ManualWriteTrackingResourceSupported);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_D3D12_OPTIONS18, RenderPassesValid);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_D3D12_OPTIONS19, MaxViewDescriptorHeapSize);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_D3D12_OPTIONS20, RecreateAtTier);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_PREDICATION, Supported);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_HARDWARE_COPY, Supported);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_D3D12_OPTIONS21, ExtendedCommandInfoSupported);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_TIGHT_ALIGNMENT, SupportTier);
  KAAMOS_SAME_LAST(D3D12_FEATURE_DATA_D3D12_OPTIONS22, Max1DDispatchMeshSize);
#undef KAAMOS_SAME_LAST
#undef KAAMOS_SAME_VALUE
}
#endif

}  // namespace
}  // namespace kaamos::d3d12
