// SPDX-License-Identifier: MIT
//
// Features of CheckFeatureSupport that the installed d3d12.h may be too old for. Programs that
// bring a newer header ask for them all the same. Numbers and layouts are those of Agility SDK
// 1.619.
#pragma once

#include <windows.h>

#include <directx/d3d12.h>

namespace kaamos::d3d12::newer {

// Values of D3D12_FEATURE.
enum class Feature : UINT {
  kOptions16 = 45,
  kOptions17 = 46,
  kOptions18 = 47,
  kOptions19 = 48,
  kOptions20 = 49,
  kPredication = 50,
  kHardwareCopy = 52,
  kOptions21 = 53,
  kTightAlignment = 54,
  kOptions22 = 65,
};

inline constexpr UINT kExecuteIndirectTier1_0 = 10;

struct Options16 {
  BOOL DynamicDepthBiasSupported;
  BOOL GPUUploadHeapSupported;
};

struct Options17 {
  BOOL NonNormalizedCoordinateSamplersSupported;
  BOOL ManualWriteTrackingResourceSupported;
};

struct Options18 {
  BOOL RenderPassesValid;
};

struct Options19 {
  BOOL MismatchingOutputDimensionsSupported;
  UINT SupportedSampleCountsWithNoOutputs;
  BOOL PointSamplingAddressesNeverRoundUp;
  BOOL RasterizerDesc2Supported;
  BOOL NarrowQuadrilateralLinesSupported;
  BOOL AnisoFilterWithPointMipSupported;
  UINT MaxSamplerDescriptorHeapSize;
  UINT MaxSamplerDescriptorHeapSizeWithStaticSamplers;
  UINT MaxViewDescriptorHeapSize;
  BOOL ComputeOnlyCustomHeapSupported;
};

struct Options20 {
  BOOL ComputeOnlyWriteWatchSupported;
  UINT RecreateAtTier;
};

struct Options21 {
  UINT WorkGraphsTier;
  UINT ExecuteIndirectTier;
  BOOL SampleCmpGradientAndBiasSupported;
  BOOL ExtendedCommandInfoSupported;
};

struct Options22 {
  BOOL ShaderExecutionReorderingActuallyReorders;
  BOOL CreateByteOffsetViewsSupported;
  UINT Max1DDispatchSize;
  UINT Max1DDispatchMeshSize;
};

// Predication, copies by hardware queues, tight alignment: one number, 0 is no.
struct Support {
  UINT supported;
};

static_assert(sizeof(Options19) == 40 && sizeof(Options21) == 16 && sizeof(Options22) == 16);

}  // namespace kaamos::d3d12::newer
