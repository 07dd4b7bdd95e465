// SPDX-License-Identifier: MIT
// CheckFeatureSupport: what rtapi has, and no more.
#include <d3d12.h>

#include <cstring>

#include "d3d12/objects/device.h"
#include "d3d12/objects/format_support.h"
#include "d3d12/objects/newer_features.h"

namespace kaamos::d3d12 {

namespace {

// The structure that a program wants filled, and who tells it of mistakes.
struct Query {
  void* data;
  UINT size;
  Reporter& reporter;
};

// Answers a query whose structure is `Data`, if the size is right.
template <class Data, class Fill>
HRESULT answer(const Query& query, const Fill& fill) {
  if (query.data == nullptr || query.size != sizeof(Data)) {
    return query.reporter.fail(ErrorId::kNullPointer,
                               "CheckFeatureSupport: pFeatureSupportData is null, or of " +
                                   std::to_string(query.size) + " bytes instead of " +
                                   std::to_string(sizeof(Data)) + ".");
  }
  return fill(*static_cast<Data*>(query.data));
}

// The same for structures that only hold answers: what `fill` does not set is no.
template <class Data, class Fill>
HRESULT options(const Query& query, const Fill& fill) {
  return answer<Data>(query, [&](Data& out) {
    out = {};
    fill(out);
    return S_OK;
  });
}

constexpr D3D_FEATURE_LEVEL kHighestLevel = D3D_FEATURE_LEVEL_12_1;
constexpr UINT kAddressBits = 40;  // of a buffer; BufferDesc::SizeInBytes

D3D_SHADER_MODEL model_of(const rtapi::Device& device) {
  return static_cast<D3D_SHADER_MODEL>(device.GetDesc().ShaderModel);
}

// A backend without opacity micromaps does not tell the size of their arrays (KA0547).
bool has_micromaps(const rtapi::Device& device) {
  const rtapi::RaytracingOpacityMicromapHistogramEntry one = {1};
  rtapi::RaytracingOpacityMicromapArrayDesc array;
  array.NumOmmHistogramEntries = 1;
  array.pOmmHistogram = &one;
  rtapi::BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = rtapi::RaytracingAccelerationStructureType::kOpacityMicromapArray;
  inputs.NumDescs = 1;
  inputs.pOpacityMicromapArrayDesc = &array;
  return bool(device.GetRaytracingAccelerationStructurePrebuildInfo(inputs));
}

// 1.2 requires opacity micromaps, which Vulkan has on lavapipe only.
D3D12_RAYTRACING_TIER highest_tier(const rtapi::Device& device) {
  auto tier = device.GetDesc().Tier;
  if (tier > rtapi::RaytracingTier::kTier1_1 && !has_micromaps(device)) {
    tier = rtapi::RaytracingTier::kTier1_1;
  }
  return static_cast<D3D12_RAYTRACING_TIER>(tier);
}

// The options behind D3D12_FEATURE_D3D12_OPTIONS15. E_INVALIDARG if there is no such feature.
HRESULT newer_feature(const Query& query, D3D12_FEATURE feature) {
  switch (static_cast<newer::Feature>(feature)) {
    case newer::Feature::kOptions16:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS16>(query, [](auto&) {});
    case newer::Feature::kOptions17:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS17>(query, [](auto&) {});
    case newer::Feature::kOptions18:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS18>(query, [](auto&) {});
    case newer::Feature::kOptions19:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS19>(query, [](auto& out) {
        out.SupportedSampleCountsWithNoOutputs = 1;  // one bit for each: a single sample
        out.MaxSamplerDescriptorHeapSize = rtapi::kMaxShaderVisibleSamplerHeapSize;
        out.MaxSamplerDescriptorHeapSizeWithStaticSamplers =
            rtapi::kMaxShaderVisibleSamplerHeapSize;
        out.MaxViewDescriptorHeapSize = rtapi::kMaxViewHeapSize;
      });
    case newer::Feature::kOptions20:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS20>(query, [](auto&) {});
    case newer::Feature::kPredication:
      return options<D3D12_FEATURE_DATA_PREDICATION>(query, [](auto&) {});
    case newer::Feature::kHardwareCopy:
      return options<D3D12_FEATURE_DATA_HARDWARE_COPY>(query, [](auto&) {});
    case newer::Feature::kTightAlignment:
      return options<D3D12_FEATURE_DATA_TIGHT_ALIGNMENT>(query, [](auto&) {});
    case newer::Feature::kOptions21:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS21>(query, [](auto& out) {
        out.ExecuteIndirectTier = D3D12_EXECUTE_INDIRECT_TIER_1_0;
        out.SampleCmpGradientAndBiasSupported = TRUE;
      });
    case newer::Feature::kOptions22:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS22>(query, [](auto& out) {
        out.Max1DDispatchSize = rtapi::kCsDispatchMaxThreadGroupsPerDimension;
      });
    default:
      return E_INVALIDARG;  // as D3D12 answers of features that it does not know
  }
}

// Planes of any format that DXGI has, whether textures may have it here or not; 0 for numbers that
// are none.
UINT8 plane_count(DXGI_FORMAT format) {
  switch (format) {
    case DXGI_FORMAT_R32G8X24_TYPELESS:
    case DXGI_FORMAT_D32_FLOAT_S8X24_UINT:
    case DXGI_FORMAT_R32_FLOAT_X8X24_TYPELESS:
    case DXGI_FORMAT_X32_TYPELESS_G8X24_UINT:
    case DXGI_FORMAT_R24G8_TYPELESS:
    case DXGI_FORMAT_D24_UNORM_S8_UINT:
    case DXGI_FORMAT_R24_UNORM_X8_TYPELESS:
    case DXGI_FORMAT_X24_TYPELESS_G8_UINT:
    case DXGI_FORMAT_NV12:
    case DXGI_FORMAT_P010:
    case DXGI_FORMAT_P016:
    case DXGI_FORMAT_NV11:
      return 2;
    default:
      return format <= DXGI_FORMAT_B4G4R4A4_UNORM && format != DXGI_FORMAT_R1_UNORM ? 1 : 0;
  }
}

HRESULT feature_levels(D3D12_FEATURE_DATA_FEATURE_LEVELS& out) {
  if (out.NumFeatureLevels == 0 || out.pFeatureLevelsRequested == nullptr) return E_INVALIDARG;
  out.MaxSupportedFeatureLevel = {};
  for (UINT i = 0; i < out.NumFeatureLevels; ++i) {
    const D3D_FEATURE_LEVEL level = out.pFeatureLevelsRequested[i];
    if (level <= kHighestLevel) {
      out.MaxSupportedFeatureLevel = std::max(out.MaxSupportedFeatureLevel, level);
    }
  }
  return S_OK;
}

}  // namespace

HRESULT Device::CheckFeatureSupport(D3D12_FEATURE feature, void* data, UINT size) {
  const Query query{data, size, reporter()};
  switch (feature) {
    case D3D12_FEATURE_D3D12_OPTIONS:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS>(query, [](auto& out) {
        out.DoublePrecisionFloatShaderOps = TRUE;
        out.OutputMergerLogicOp = TRUE;
        out.ResourceBindingTier = D3D12_RESOURCE_BINDING_TIER_3;
        out.TypedUAVLoadAdditionalFormats = TRUE;
        out.MaxGPUVirtualAddressBitsPerResource = kAddressBits;
        out.VPAndRTArrayIndexFromAnyShaderFeedingRasterizerSupportedWithoutGSEmulation = TRUE;
        out.ResourceHeapTier = D3D12_RESOURCE_HEAP_TIER_2;
      });
    case D3D12_FEATURE_ARCHITECTURE:
      return answer<D3D12_FEATURE_DATA_ARCHITECTURE>(query, [](auto& out) {
        if (out.NodeIndex != 0) return E_INVALIDARG;
        out = {0, FALSE, FALSE, FALSE};  // custom heaps do not do all that UMA promises
        return S_OK;
      });
    case D3D12_FEATURE_ARCHITECTURE1:
      return answer<D3D12_FEATURE_DATA_ARCHITECTURE1>(query, [](auto& out) {
        if (out.NodeIndex != 0) return E_INVALIDARG;
        out = {0, FALSE, FALSE, FALSE, FALSE};
        return S_OK;
      });
    case D3D12_FEATURE_FEATURE_LEVELS:
      return answer<D3D12_FEATURE_DATA_FEATURE_LEVELS>(query, feature_levels);
    case D3D12_FEATURE_FORMAT_SUPPORT:
      return answer<D3D12_FEATURE_DATA_FORMAT_SUPPORT>(query, [this](auto& out) {
        out = format_support(device_, out.Format);
        return S_OK;
      });
    case D3D12_FEATURE_MULTISAMPLE_QUALITY_LEVELS:
      return answer<D3D12_FEATURE_DATA_MULTISAMPLE_QUALITY_LEVELS>(query, [this](auto& out) {
        out.NumQualityLevels = out.SampleCount == 1
                                   ? 1
                                   : device_.GetMultisampleQualityLevels(
                                         static_cast<rtapi::Format>(out.Format), out.SampleCount);
        return out.SampleCount == 0 ? E_FAIL : S_OK;
      });
    case D3D12_FEATURE_FORMAT_INFO:
      return answer<D3D12_FEATURE_DATA_FORMAT_INFO>(query, [](auto& out) {
        out.PlaneCount = plane_count(out.Format);
        return out.PlaneCount != 0 ? S_OK : E_INVALIDARG;
      });
    case D3D12_FEATURE_GPU_VIRTUAL_ADDRESS_SUPPORT:
      return options<D3D12_FEATURE_DATA_GPU_VIRTUAL_ADDRESS_SUPPORT>(query, [](auto& out) {
        out = {kAddressBits, 47};
      });
    case D3D12_FEATURE_SHADER_MODEL:
      // A program asks with the highest model it knows and gets the lower of the two.
      return answer<D3D12_FEATURE_DATA_SHADER_MODEL>(query, [this](auto& out) {
        if (out.HighestShaderModel < D3D_SHADER_MODEL_5_1) return E_INVALIDARG;
        out.HighestShaderModel = std::min(out.HighestShaderModel, model_of(device_));
        return S_OK;
      });
    case D3D12_FEATURE_ROOT_SIGNATURE:
      return answer<D3D12_FEATURE_DATA_ROOT_SIGNATURE>(query, [](auto& out) {
        if (out.HighestVersion < D3D_ROOT_SIGNATURE_VERSION_1_0) return E_INVALIDARG;
        out.HighestVersion = std::min(out.HighestVersion, D3D_ROOT_SIGNATURE_VERSION_1_1);
        return S_OK;
      });
    case D3D12_FEATURE_COMMAND_QUEUE_PRIORITY:
      return answer<D3D12_FEATURE_DATA_COMMAND_QUEUE_PRIORITY>(query, [](auto& out) {
        out.PriorityForTypeIsSupported = out.CommandListType == D3D12_COMMAND_LIST_TYPE_DIRECT ||
                                         out.CommandListType == D3D12_COMMAND_LIST_TYPE_COMPUTE ||
                                         out.CommandListType == D3D12_COMMAND_LIST_TYPE_COPY;
        return S_OK;
      });
    case D3D12_FEATURE_SERIALIZATION:
      return answer<D3D12_FEATURE_DATA_SERIALIZATION>(query, [](auto& out) {
        if (out.NodeIndex != 0) return E_INVALIDARG;
        out.HeapSerializationTier = D3D12_HEAP_SERIALIZATION_TIER_0;
        return S_OK;
      });
    case D3D12_FEATURE_D3D12_OPTIONS1:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS1>(query, [this](auto& out) {
        const uint32_t lanes = device_.GetDesc().WaveLanes;
        out.WaveOps = TRUE;
        out.WaveLaneCountMin = lanes != 0 ? lanes : 8;
        out.WaveLaneCountMax = out.WaveLaneCountMin;
        out.TotalLaneCount = out.WaveLaneCountMin * device_.GetInfo().HardwareThreads;
        out.ExpandedComputeResourceStates = TRUE;
        out.Int64ShaderOps = TRUE;
      });
    case D3D12_FEATURE_D3D12_OPTIONS2:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS2>(query, [](auto&) {});
    case D3D12_FEATURE_D3D12_OPTIONS3:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS3>(query, [](auto& out) {
        out.CopyQueueTimestampQueriesSupported = TRUE;
        out.CastingFullyTypedFormatSupported = TRUE;
      });
    case D3D12_FEATURE_D3D12_OPTIONS4:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS4>(
          query, [](auto& out) { out.Native16BitShaderOpsSupported = TRUE; });
    case D3D12_FEATURE_D3D12_OPTIONS5:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS5>(query, [this](auto& out) {
        out.RenderPassesTier = D3D12_RENDER_PASS_TIER_0;
        out.RaytracingTier = highest_tier(device_);
      });
    case D3D12_FEATURE_D3D12_OPTIONS6:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS6>(query, [](auto&) {});
    case D3D12_FEATURE_D3D12_OPTIONS7:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS7>(query, [](auto&) {});
    case D3D12_FEATURE_D3D12_OPTIONS8:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS8>(
          query, [](auto& out) { out.UnalignedBlockTexturesSupported = TRUE; });
    case D3D12_FEATURE_D3D12_OPTIONS9:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS9>(query, [](auto&) {});
    case D3D12_FEATURE_D3D12_OPTIONS10:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS10>(query, [](auto&) {});
    case D3D12_FEATURE_D3D12_OPTIONS11:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS11>(query, [](auto&) {});
    case D3D12_FEATURE_D3D12_OPTIONS12:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS12>(query, [](auto& out) {
        out.MSPrimitivesPipelineStatisticIncludesCulledPrimitives = D3D12_TRI_STATE_FALSE;
        out.EnhancedBarriersSupported = TRUE;
      });
    case D3D12_FEATURE_D3D12_OPTIONS13:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS13>(query, [](auto& out) {
        out.InvertedViewportHeightFlipsYSupported = TRUE;
        out.InvertedViewportDepthFlipsZSupported = TRUE;
      });
    case D3D12_FEATURE_D3D12_OPTIONS14:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS14>(query, [](auto&) {});
    case D3D12_FEATURE_D3D12_OPTIONS15:
      return options<D3D12_FEATURE_DATA_D3D12_OPTIONS15>(query, [](auto&) {});
    case D3D12_FEATURE_EXISTING_HEAPS:
      return options<D3D12_FEATURE_DATA_EXISTING_HEAPS>(query, [](auto&) {});
    case D3D12_FEATURE_SHADER_CACHE:
      return options<D3D12_FEATURE_DATA_SHADER_CACHE>(query, [](auto& out) {
        out.SupportFlags = D3D12_SHADER_CACHE_SUPPORT_SINGLE_PSO |
                           D3D12_SHADER_CACHE_SUPPORT_LIBRARY |
                           D3D12_SHADER_CACHE_SUPPORT_AUTOMATIC_INPROC_CACHE |
                           D3D12_SHADER_CACHE_SUPPORT_AUTOMATIC_DISK_CACHE;
      });
    case D3D12_FEATURE_CROSS_NODE:
      return options<D3D12_FEATURE_DATA_CROSS_NODE>(query, [](auto&) {});
    case D3D12_FEATURE_DISPLAYABLE:
      return options<D3D12_FEATURE_DATA_DISPLAYABLE>(query, [](auto&) {});
    default:
      return newer_feature(query, feature);
  }
}

}  // namespace kaamos::d3d12
