// SPDX-License-Identifier: MIT
//
// Constants and enumerations, but for formats and graphics pipelines.
#include "rtapi/testing/same_layout.h"

namespace rtapi::testing {
namespace {

constexpr int kFirst = __COUNTER__;

// Constants
SAME_VALUE(rtapi::kShaderIdentifierSizeInBytes, D3D12_SHADER_IDENTIFIER_SIZE_IN_BYTES);
SAME_VALUE(rtapi::kRaytracingShaderRecordByteAlignment,
           D3D12_RAYTRACING_SHADER_RECORD_BYTE_ALIGNMENT);
SAME_VALUE(rtapi::kRaytracingShaderTableByteAlignment,
           D3D12_RAYTRACING_SHADER_TABLE_BYTE_ALIGNMENT);
SAME_VALUE(rtapi::kRaytracingMaxShaderRecordStride, D3D12_RAYTRACING_MAX_SHADER_RECORD_STRIDE);
SAME_VALUE(rtapi::kRaytracingAccelerationStructureByteAlignment,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BYTE_ALIGNMENT);
SAME_VALUE(rtapi::kRaytracingInstanceDescsByteAlignment,
           D3D12_RAYTRACING_INSTANCE_DESCS_BYTE_ALIGNMENT);
SAME_VALUE(rtapi::kRaytracingTransform3x4ByteAlignment,
           D3D12_RAYTRACING_TRANSFORM3X4_BYTE_ALIGNMENT);
SAME_VALUE(rtapi::kRaytracingAabbByteAlignment, D3D12_RAYTRACING_AABB_BYTE_ALIGNMENT);
SAME_VALUE(rtapi::kRaytracingMaxAttributeSizeInBytes, D3D12_RAYTRACING_MAX_ATTRIBUTE_SIZE_IN_BYTES);
SAME_VALUE(rtapi::kRaytracingMaxDeclarableTraceRecursionDepth,
           D3D12_RAYTRACING_MAX_DECLARABLE_TRACE_RECURSION_DEPTH);
SAME_VALUE(rtapi::kRaytracingMaxRayGenerationShaderThreads,
           D3D12_RAYTRACING_MAX_RAY_GENERATION_SHADER_THREADS);
SAME_VALUE(rtapi::kRaytracingMaxGeometriesPerBottomLevelAccelerationStructure,
           D3D12_RAYTRACING_MAX_GEOMETRIES_PER_BOTTOM_LEVEL_ACCELERATION_STRUCTURE);
SAME_VALUE(rtapi::kRaytracingMaxInstancesPerTopLevelAccelerationStructure,
           D3D12_RAYTRACING_MAX_INSTANCES_PER_TOP_LEVEL_ACCELERATION_STRUCTURE);
SAME_VALUE(rtapi::kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure,
           D3D12_RAYTRACING_MAX_PRIMITIVES_PER_BOTTOM_LEVEL_ACCELERATION_STRUCTURE);
SAME_VALUE(rtapi::kMaxRootCost, D3D12_MAX_ROOT_COST);
SAME_VALUE(rtapi::kTextureDataPitchAlignment, D3D12_TEXTURE_DATA_PITCH_ALIGNMENT);
SAME_VALUE(rtapi::kTextureDataPlacementAlignment, D3D12_TEXTURE_DATA_PLACEMENT_ALIGNMENT);
SAME_VALUE(rtapi::kConstantBufferDataPlacementAlignment,
           D3D12_CONSTANT_BUFFER_DATA_PLACEMENT_ALIGNMENT);
SAME_VALUE(rtapi::kRawUavSrvByteAlignment, D3D12_RAW_UAV_SRV_BYTE_ALIGNMENT);
SAME_VALUE(rtapi::kReqTexture1DUDimension, D3D12_REQ_TEXTURE1D_U_DIMENSION);
SAME_VALUE(rtapi::kReqTexture2DUOrVDimension, D3D12_REQ_TEXTURE2D_U_OR_V_DIMENSION);
SAME_VALUE(rtapi::kReqTexture3DUVOrWDimension, D3D12_REQ_TEXTURE3D_U_V_OR_W_DIMENSION);
SAME_VALUE(rtapi::kReqTexture2DArrayAxisDimension, D3D12_REQ_TEXTURE2D_ARRAY_AXIS_DIMENSION);
SAME_VALUE(rtapi::kCsDispatchMaxThreadGroupsPerDimension,
           D3D12_CS_DISPATCH_MAX_THREAD_GROUPS_PER_DIMENSION);
SAME_VALUE(rtapi::kMaxShaderVisibleSamplerHeapSize, D3D12_MAX_SHADER_VISIBLE_SAMPLER_HEAP_SIZE);
SAME_VALUE(rtapi::kDescriptorRangeOffsetAppend, D3D12_DESCRIPTOR_RANGE_OFFSET_APPEND);
SAME_VALUE(rtapi::kResourceBarrierAllSubresources, D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES);
SAME_VALUE(rtapi::kDefaultShader4ComponentMapping, D3D12_DEFAULT_SHADER_4_COMPONENT_MAPPING);
static_assert(rtapi::kFloat32Max == D3D12_FLOAT32_MAX);

// D3D12_DESCRIPTOR_HEAP_TYPE
SAME_VALUE(rtapi::DescriptorHeapType::kCbvSrvUav, D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV);
SAME_VALUE(rtapi::DescriptorHeapType::kSampler, D3D12_DESCRIPTOR_HEAP_TYPE_SAMPLER);

// D3D12_DESCRIPTOR_HEAP_FLAG
SAME_VALUE(rtapi::DescriptorHeapFlags::kNone, D3D12_DESCRIPTOR_HEAP_FLAG_NONE);
SAME_VALUE(rtapi::DescriptorHeapFlags::kShaderVisible, D3D12_DESCRIPTOR_HEAP_FLAG_SHADER_VISIBLE);

// D3D12_SRV_DIMENSION
SAME_VALUE(rtapi::SrvDimension::kUnknown, D3D12_SRV_DIMENSION_UNKNOWN);
SAME_VALUE(rtapi::SrvDimension::kBuffer, D3D12_SRV_DIMENSION_BUFFER);
SAME_VALUE(rtapi::SrvDimension::kTexture1D, D3D12_SRV_DIMENSION_TEXTURE1D);
SAME_VALUE(rtapi::SrvDimension::kTexture1DArray, D3D12_SRV_DIMENSION_TEXTURE1DARRAY);
SAME_VALUE(rtapi::SrvDimension::kTexture2D, D3D12_SRV_DIMENSION_TEXTURE2D);
SAME_VALUE(rtapi::SrvDimension::kTexture2DArray, D3D12_SRV_DIMENSION_TEXTURE2DARRAY);
SAME_VALUE(rtapi::SrvDimension::kTexture2DMS, D3D12_SRV_DIMENSION_TEXTURE2DMS);
SAME_VALUE(rtapi::SrvDimension::kTexture2DMSArray, D3D12_SRV_DIMENSION_TEXTURE2DMSARRAY);
SAME_VALUE(rtapi::SrvDimension::kTexture3D, D3D12_SRV_DIMENSION_TEXTURE3D);
SAME_VALUE(rtapi::SrvDimension::kTextureCube, D3D12_SRV_DIMENSION_TEXTURECUBE);
SAME_VALUE(rtapi::SrvDimension::kTextureCubeArray, D3D12_SRV_DIMENSION_TEXTURECUBEARRAY);
SAME_VALUE(rtapi::SrvDimension::kRaytracingAccelerationStructure,
           D3D12_SRV_DIMENSION_RAYTRACING_ACCELERATION_STRUCTURE);

// D3D12_BUFFER_SRV_FLAG
SAME_VALUE(rtapi::BufferSrvFlags::kNone, D3D12_BUFFER_SRV_FLAG_NONE);
SAME_VALUE(rtapi::BufferSrvFlags::kRaw, D3D12_BUFFER_SRV_FLAG_RAW);

// D3D12_UAV_DIMENSION
SAME_VALUE(rtapi::UavDimension::kUnknown, D3D12_UAV_DIMENSION_UNKNOWN);
SAME_VALUE(rtapi::UavDimension::kBuffer, D3D12_UAV_DIMENSION_BUFFER);
SAME_VALUE(rtapi::UavDimension::kTexture1D, D3D12_UAV_DIMENSION_TEXTURE1D);
SAME_VALUE(rtapi::UavDimension::kTexture1DArray, D3D12_UAV_DIMENSION_TEXTURE1DARRAY);
SAME_VALUE(rtapi::UavDimension::kTexture2D, D3D12_UAV_DIMENSION_TEXTURE2D);
SAME_VALUE(rtapi::UavDimension::kTexture2DArray, D3D12_UAV_DIMENSION_TEXTURE2DARRAY);
SAME_VALUE(rtapi::UavDimension::kTexture3D, D3D12_UAV_DIMENSION_TEXTURE3D);

// D3D12_BUFFER_UAV_FLAG
SAME_VALUE(rtapi::BufferUavFlags::kNone, D3D12_BUFFER_UAV_FLAG_NONE);
SAME_VALUE(rtapi::BufferUavFlags::kRaw, D3D12_BUFFER_UAV_FLAG_RAW);

// D3D12_FILTER
SAME_VALUE(rtapi::Filter::kMinMagMipPoint, D3D12_FILTER_MIN_MAG_MIP_POINT);
SAME_VALUE(rtapi::Filter::kMinMagPointMipLinear, D3D12_FILTER_MIN_MAG_POINT_MIP_LINEAR);
SAME_VALUE(rtapi::Filter::kMinPointMagLinearMipPoint, D3D12_FILTER_MIN_POINT_MAG_LINEAR_MIP_POINT);
SAME_VALUE(rtapi::Filter::kMinPointMagMipLinear, D3D12_FILTER_MIN_POINT_MAG_MIP_LINEAR);
SAME_VALUE(rtapi::Filter::kMinLinearMagMipPoint, D3D12_FILTER_MIN_LINEAR_MAG_MIP_POINT);
SAME_VALUE(rtapi::Filter::kMinLinearMagPointMipLinear,
           D3D12_FILTER_MIN_LINEAR_MAG_POINT_MIP_LINEAR);
SAME_VALUE(rtapi::Filter::kMinMagLinearMipPoint, D3D12_FILTER_MIN_MAG_LINEAR_MIP_POINT);
SAME_VALUE(rtapi::Filter::kMinMagMipLinear, D3D12_FILTER_MIN_MAG_MIP_LINEAR);
SAME_VALUE(rtapi::Filter::kAnisotropic, D3D12_FILTER_ANISOTROPIC);
SAME_VALUE(rtapi::Filter::kComparisonMinMagMipPoint, D3D12_FILTER_COMPARISON_MIN_MAG_MIP_POINT);
SAME_VALUE(rtapi::Filter::kComparisonMinMagPointMipLinear,
           D3D12_FILTER_COMPARISON_MIN_MAG_POINT_MIP_LINEAR);
SAME_VALUE(rtapi::Filter::kComparisonMinPointMagLinearMipPoint,
           D3D12_FILTER_COMPARISON_MIN_POINT_MAG_LINEAR_MIP_POINT);
SAME_VALUE(rtapi::Filter::kComparisonMinPointMagMipLinear,
           D3D12_FILTER_COMPARISON_MIN_POINT_MAG_MIP_LINEAR);
SAME_VALUE(rtapi::Filter::kComparisonMinLinearMagMipPoint,
           D3D12_FILTER_COMPARISON_MIN_LINEAR_MAG_MIP_POINT);
SAME_VALUE(rtapi::Filter::kComparisonMinLinearMagPointMipLinear,
           D3D12_FILTER_COMPARISON_MIN_LINEAR_MAG_POINT_MIP_LINEAR);
SAME_VALUE(rtapi::Filter::kComparisonMinMagLinearMipPoint,
           D3D12_FILTER_COMPARISON_MIN_MAG_LINEAR_MIP_POINT);
SAME_VALUE(rtapi::Filter::kComparisonMinMagMipLinear, D3D12_FILTER_COMPARISON_MIN_MAG_MIP_LINEAR);
SAME_VALUE(rtapi::Filter::kComparisonAnisotropic, D3D12_FILTER_COMPARISON_ANISOTROPIC);
SAME_VALUE(rtapi::Filter::kMinimumMinMagMipPoint, D3D12_FILTER_MINIMUM_MIN_MAG_MIP_POINT);
SAME_VALUE(rtapi::Filter::kMinimumMinMagMipLinear, D3D12_FILTER_MINIMUM_MIN_MAG_MIP_LINEAR);
SAME_VALUE(rtapi::Filter::kMaximumMinMagMipPoint, D3D12_FILTER_MAXIMUM_MIN_MAG_MIP_POINT);
SAME_VALUE(rtapi::Filter::kMaximumMinMagMipLinear, D3D12_FILTER_MAXIMUM_MIN_MAG_MIP_LINEAR);

// D3D12_TEXTURE_ADDRESS_MODE
SAME_VALUE(rtapi::TextureAddressMode::kWrap, D3D12_TEXTURE_ADDRESS_MODE_WRAP);
SAME_VALUE(rtapi::TextureAddressMode::kMirror, D3D12_TEXTURE_ADDRESS_MODE_MIRROR);
SAME_VALUE(rtapi::TextureAddressMode::kClamp, D3D12_TEXTURE_ADDRESS_MODE_CLAMP);
SAME_VALUE(rtapi::TextureAddressMode::kBorder, D3D12_TEXTURE_ADDRESS_MODE_BORDER);
SAME_VALUE(rtapi::TextureAddressMode::kMirrorOnce, D3D12_TEXTURE_ADDRESS_MODE_MIRROR_ONCE);

// D3D12_COMPARISON_FUNC
SAME_VALUE(rtapi::ComparisonFunc::kNone, D3D12_COMPARISON_FUNC_NONE);
SAME_VALUE(rtapi::ComparisonFunc::kNever, D3D12_COMPARISON_FUNC_NEVER);
SAME_VALUE(rtapi::ComparisonFunc::kLess, D3D12_COMPARISON_FUNC_LESS);
SAME_VALUE(rtapi::ComparisonFunc::kEqual, D3D12_COMPARISON_FUNC_EQUAL);
SAME_VALUE(rtapi::ComparisonFunc::kLessEqual, D3D12_COMPARISON_FUNC_LESS_EQUAL);
SAME_VALUE(rtapi::ComparisonFunc::kGreater, D3D12_COMPARISON_FUNC_GREATER);
SAME_VALUE(rtapi::ComparisonFunc::kNotEqual, D3D12_COMPARISON_FUNC_NOT_EQUAL);
SAME_VALUE(rtapi::ComparisonFunc::kGreaterEqual, D3D12_COMPARISON_FUNC_GREATER_EQUAL);
SAME_VALUE(rtapi::ComparisonFunc::kAlways, D3D12_COMPARISON_FUNC_ALWAYS);

// D3D12_STATIC_BORDER_COLOR
SAME_VALUE(rtapi::StaticBorderColor::kTransparentBlack,
           D3D12_STATIC_BORDER_COLOR_TRANSPARENT_BLACK);
SAME_VALUE(rtapi::StaticBorderColor::kOpaqueBlack, D3D12_STATIC_BORDER_COLOR_OPAQUE_BLACK);
SAME_VALUE(rtapi::StaticBorderColor::kOpaqueWhite, D3D12_STATIC_BORDER_COLOR_OPAQUE_WHITE);
SAME_VALUE(rtapi::StaticBorderColor::kOpaqueBlackUint, D3D12_STATIC_BORDER_COLOR_OPAQUE_BLACK_UINT);
SAME_VALUE(rtapi::StaticBorderColor::kOpaqueWhiteUint, D3D12_STATIC_BORDER_COLOR_OPAQUE_WHITE_UINT);
SAME_VALUE(rtapi::SamplerFlags::kUintBorderColor, D3D12_SAMPLER_FLAG_UINT_BORDER_COLOR);

// D3D12_RAYTRACING_TIER
SAME_VALUE(rtapi::RaytracingTier::kNotSupported, D3D12_RAYTRACING_TIER_NOT_SUPPORTED);
SAME_VALUE(rtapi::RaytracingTier::kTier1_0, D3D12_RAYTRACING_TIER_1_0);
SAME_VALUE(rtapi::RaytracingTier::kTier1_1, D3D12_RAYTRACING_TIER_1_1);

// D3D12_RAY_FLAG
SAME_VALUE(rtapi::RayFlags::kNone, D3D12_RAY_FLAG_NONE);
SAME_VALUE(rtapi::RayFlags::kForceOpaque, D3D12_RAY_FLAG_FORCE_OPAQUE);
SAME_VALUE(rtapi::RayFlags::kForceNonOpaque, D3D12_RAY_FLAG_FORCE_NON_OPAQUE);
SAME_VALUE(rtapi::RayFlags::kAcceptFirstHitAndEndSearch,
           D3D12_RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH);
SAME_VALUE(rtapi::RayFlags::kSkipClosestHitShader, D3D12_RAY_FLAG_SKIP_CLOSEST_HIT_SHADER);
SAME_VALUE(rtapi::RayFlags::kCullBackFacingTriangles, D3D12_RAY_FLAG_CULL_BACK_FACING_TRIANGLES);
SAME_VALUE(rtapi::RayFlags::kCullFrontFacingTriangles, D3D12_RAY_FLAG_CULL_FRONT_FACING_TRIANGLES);
SAME_VALUE(rtapi::RayFlags::kCullOpaque, D3D12_RAY_FLAG_CULL_OPAQUE);
SAME_VALUE(rtapi::RayFlags::kCullNonOpaque, D3D12_RAY_FLAG_CULL_NON_OPAQUE);
SAME_VALUE(rtapi::RayFlags::kSkipTriangles, D3D12_RAY_FLAG_SKIP_TRIANGLES);
SAME_VALUE(rtapi::RayFlags::kSkipProceduralPrimitives, D3D12_RAY_FLAG_SKIP_PROCEDURAL_PRIMITIVES);

// D3D12_RAYTRACING_GEOMETRY_TYPE
SAME_VALUE(rtapi::RaytracingGeometryType::kTriangles, D3D12_RAYTRACING_GEOMETRY_TYPE_TRIANGLES);
SAME_VALUE(rtapi::RaytracingGeometryType::kProceduralPrimitiveAabbs,
           D3D12_RAYTRACING_GEOMETRY_TYPE_PROCEDURAL_PRIMITIVE_AABBS);

// D3D12_RAYTRACING_GEOMETRY_FLAG
SAME_VALUE(rtapi::RaytracingGeometryFlags::kNone, D3D12_RAYTRACING_GEOMETRY_FLAG_NONE);
SAME_VALUE(rtapi::RaytracingGeometryFlags::kOpaque, D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE);
SAME_VALUE(rtapi::RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation,
           D3D12_RAYTRACING_GEOMETRY_FLAG_NO_DUPLICATE_ANYHIT_INVOCATION);

// D3D12_RAYTRACING_INSTANCE_FLAG
SAME_VALUE(rtapi::RaytracingInstanceFlags::kNone, D3D12_RAYTRACING_INSTANCE_FLAG_NONE);
SAME_VALUE(rtapi::RaytracingInstanceFlags::kTriangleCullDisable,
           D3D12_RAYTRACING_INSTANCE_FLAG_TRIANGLE_CULL_DISABLE);
SAME_VALUE(rtapi::RaytracingInstanceFlags::kTriangleFrontCounterclockwise,
           D3D12_RAYTRACING_INSTANCE_FLAG_TRIANGLE_FRONT_COUNTERCLOCKWISE);
SAME_VALUE(rtapi::RaytracingInstanceFlags::kForceOpaque,
           D3D12_RAYTRACING_INSTANCE_FLAG_FORCE_OPAQUE);
SAME_VALUE(rtapi::RaytracingInstanceFlags::kForceNonOpaque,
           D3D12_RAYTRACING_INSTANCE_FLAG_FORCE_NON_OPAQUE);

// D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE
SAME_VALUE(rtapi::RaytracingAccelerationStructureType::kTopLevel,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL);
SAME_VALUE(rtapi::RaytracingAccelerationStructureType::kBottomLevel,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL);

// D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG
SAME_VALUE(rtapi::RaytracingAccelerationStructureBuildFlags::kNone,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_NONE);
SAME_VALUE(rtapi::RaytracingAccelerationStructureBuildFlags::kAllowUpdate,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_ALLOW_UPDATE);
SAME_VALUE(rtapi::RaytracingAccelerationStructureBuildFlags::kAllowCompaction,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_ALLOW_COMPACTION);
SAME_VALUE(rtapi::RaytracingAccelerationStructureBuildFlags::kPreferFastTrace,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PREFER_FAST_TRACE);
SAME_VALUE(rtapi::RaytracingAccelerationStructureBuildFlags::kPreferFastBuild,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PREFER_FAST_BUILD);
SAME_VALUE(rtapi::RaytracingAccelerationStructureBuildFlags::kMinimizeMemory,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_MINIMIZE_MEMORY);
SAME_VALUE(rtapi::RaytracingAccelerationStructureBuildFlags::kPerformUpdate,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PERFORM_UPDATE);

// D3D12_ELEMENTS_LAYOUT
SAME_VALUE(rtapi::ElementsLayout::kArray, D3D12_ELEMENTS_LAYOUT_ARRAY);
SAME_VALUE(rtapi::ElementsLayout::kArrayOfPointers, D3D12_ELEMENTS_LAYOUT_ARRAY_OF_POINTERS);

// D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO
SAME_VALUE(rtapi::RaytracingAccelerationStructurePostbuildInfoType::kCompactedSize,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_COMPACTED_SIZE);
SAME_VALUE(rtapi::RaytracingAccelerationStructurePostbuildInfoType::kToolsVisualization,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_TOOLS_VISUALIZATION);
SAME_VALUE(rtapi::RaytracingAccelerationStructurePostbuildInfoType::kSerialization,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_SERIALIZATION);
SAME_VALUE(rtapi::RaytracingAccelerationStructurePostbuildInfoType::kCurrentSize,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_CURRENT_SIZE);

// D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE
SAME_VALUE(rtapi::RaytracingAccelerationStructureCopyMode::kClone,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE_CLONE);
SAME_VALUE(rtapi::RaytracingAccelerationStructureCopyMode::kCompact,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE_COMPACT);
SAME_VALUE(rtapi::RaytracingAccelerationStructureCopyMode::kVisualizationDecodeForTools,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE_VISUALIZATION_DECODE_FOR_TOOLS);
SAME_VALUE(rtapi::RaytracingAccelerationStructureCopyMode::kSerialize,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE_SERIALIZE);
SAME_VALUE(rtapi::RaytracingAccelerationStructureCopyMode::kDeserialize,
           D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE_DESERIALIZE);

// D3D12_HEAP_TYPE
SAME_VALUE(rtapi::HeapType::kDefault, D3D12_HEAP_TYPE_DEFAULT);
SAME_VALUE(rtapi::HeapType::kUpload, D3D12_HEAP_TYPE_UPLOAD);
SAME_VALUE(rtapi::HeapType::kReadback, D3D12_HEAP_TYPE_READBACK);

// D3D12_RESOURCE_DIMENSION
SAME_VALUE(rtapi::ResourceDimension::kUnknown, D3D12_RESOURCE_DIMENSION_UNKNOWN);
SAME_VALUE(rtapi::ResourceDimension::kBuffer, D3D12_RESOURCE_DIMENSION_BUFFER);
SAME_VALUE(rtapi::ResourceDimension::kTexture1D, D3D12_RESOURCE_DIMENSION_TEXTURE1D);
SAME_VALUE(rtapi::ResourceDimension::kTexture2D, D3D12_RESOURCE_DIMENSION_TEXTURE2D);
SAME_VALUE(rtapi::ResourceDimension::kTexture3D, D3D12_RESOURCE_DIMENSION_TEXTURE3D);

// D3D12_RESOURCE_FLAG
SAME_VALUE(rtapi::ResourceFlags::kNone, D3D12_RESOURCE_FLAG_NONE);
SAME_VALUE(rtapi::ResourceFlags::kAllowUnorderedAccess, D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);

// D3D12_RESOURCE_STATE
SAME_VALUE(rtapi::ResourceStates::kCommon, D3D12_RESOURCE_STATE_COMMON);
SAME_VALUE(rtapi::ResourceStates::kVertexAndConstantBuffer,
           D3D12_RESOURCE_STATE_VERTEX_AND_CONSTANT_BUFFER);
SAME_VALUE(rtapi::ResourceStates::kUnorderedAccess, D3D12_RESOURCE_STATE_UNORDERED_ACCESS);
SAME_VALUE(rtapi::ResourceStates::kNonPixelShaderResource,
           D3D12_RESOURCE_STATE_NON_PIXEL_SHADER_RESOURCE);
SAME_VALUE(rtapi::ResourceStates::kPixelShaderResource, D3D12_RESOURCE_STATE_PIXEL_SHADER_RESOURCE);
SAME_VALUE(rtapi::ResourceStates::kIndirectArgument, D3D12_RESOURCE_STATE_INDIRECT_ARGUMENT);
SAME_VALUE(rtapi::ResourceStates::kCopyDest, D3D12_RESOURCE_STATE_COPY_DEST);
SAME_VALUE(rtapi::ResourceStates::kCopySource, D3D12_RESOURCE_STATE_COPY_SOURCE);
SAME_VALUE(rtapi::ResourceStates::kResolveDest, D3D12_RESOURCE_STATE_RESOLVE_DEST);
SAME_VALUE(rtapi::ResourceStates::kResolveSource, D3D12_RESOURCE_STATE_RESOLVE_SOURCE);
SAME_VALUE(rtapi::ResolveMode::kDecompress, D3D12_RESOLVE_MODE_DECOMPRESS);
SAME_VALUE(rtapi::ResolveMode::kMin, D3D12_RESOLVE_MODE_MIN);
SAME_VALUE(rtapi::ResolveMode::kMax, D3D12_RESOLVE_MODE_MAX);
SAME_VALUE(rtapi::ResolveMode::kAverage, D3D12_RESOLVE_MODE_AVERAGE);
SAME_VALUE(rtapi::ResourceStates::kGenericRead, D3D12_RESOURCE_STATE_GENERIC_READ);
SAME_VALUE(rtapi::ResourceStates::kAllShaderResource, D3D12_RESOURCE_STATE_ALL_SHADER_RESOURCE);
SAME_VALUE(rtapi::ResourceStates::kRaytracingAccelerationStructure,
           D3D12_RESOURCE_STATE_RAYTRACING_ACCELERATION_STRUCTURE);

// D3D12_RESOURCE_BARRIER_TYPE
SAME_VALUE(rtapi::ResourceBarrierType::kTransition, D3D12_RESOURCE_BARRIER_TYPE_TRANSITION);
SAME_VALUE(rtapi::ResourceBarrierType::kAliasing, D3D12_RESOURCE_BARRIER_TYPE_ALIASING);
SAME_VALUE(rtapi::ResourceBarrierType::kUav, D3D12_RESOURCE_BARRIER_TYPE_UAV);

// D3D12_TEXTURE_COPY_TYPE
SAME_VALUE(rtapi::TextureCopyType::kSubresourceIndex, D3D12_TEXTURE_COPY_TYPE_SUBRESOURCE_INDEX);
SAME_VALUE(rtapi::TextureCopyType::kPlacedFootprint, D3D12_TEXTURE_COPY_TYPE_PLACED_FOOTPRINT);

// D3D12_DESCRIPTOR_RANGE_TYPE
SAME_VALUE(rtapi::DescriptorRangeType::kSrv, D3D12_DESCRIPTOR_RANGE_TYPE_SRV);
SAME_VALUE(rtapi::DescriptorRangeType::kUav, D3D12_DESCRIPTOR_RANGE_TYPE_UAV);
SAME_VALUE(rtapi::DescriptorRangeType::kCbv, D3D12_DESCRIPTOR_RANGE_TYPE_CBV);
SAME_VALUE(rtapi::DescriptorRangeType::kSampler, D3D12_DESCRIPTOR_RANGE_TYPE_SAMPLER);

// D3D12_DESCRIPTOR_RANGE_FLAG
SAME_VALUE(rtapi::DescriptorRangeFlags::kNone, D3D12_DESCRIPTOR_RANGE_FLAG_NONE);
SAME_VALUE(rtapi::DescriptorRangeFlags::kDescriptorsVolatile,
           D3D12_DESCRIPTOR_RANGE_FLAG_DESCRIPTORS_VOLATILE);
SAME_VALUE(rtapi::DescriptorRangeFlags::kDataVolatile, D3D12_DESCRIPTOR_RANGE_FLAG_DATA_VOLATILE);
SAME_VALUE(rtapi::DescriptorRangeFlags::kDataStaticWhileSetAtExecute,
           D3D12_DESCRIPTOR_RANGE_FLAG_DATA_STATIC_WHILE_SET_AT_EXECUTE);
SAME_VALUE(rtapi::DescriptorRangeFlags::kDataStatic, D3D12_DESCRIPTOR_RANGE_FLAG_DATA_STATIC);
SAME_VALUE(rtapi::DescriptorRangeFlags::kDescriptorsStaticKeepingBufferBoundsChecks,
           D3D12_DESCRIPTOR_RANGE_FLAG_DESCRIPTORS_STATIC_KEEPING_BUFFER_BOUNDS_CHECKS);

// D3D12_ROOT_DESCRIPTOR_FLAG
SAME_VALUE(rtapi::RootDescriptorFlags::kNone, D3D12_ROOT_DESCRIPTOR_FLAG_NONE);
SAME_VALUE(rtapi::RootDescriptorFlags::kDataVolatile, D3D12_ROOT_DESCRIPTOR_FLAG_DATA_VOLATILE);
SAME_VALUE(rtapi::RootDescriptorFlags::kDataStaticWhileSetAtExecute,
           D3D12_ROOT_DESCRIPTOR_FLAG_DATA_STATIC_WHILE_SET_AT_EXECUTE);
SAME_VALUE(rtapi::RootDescriptorFlags::kDataStatic, D3D12_ROOT_DESCRIPTOR_FLAG_DATA_STATIC);

// D3D12_ROOT_PARAMETER_TYPE
SAME_VALUE(rtapi::RootParameterType::kDescriptorTable, D3D12_ROOT_PARAMETER_TYPE_DESCRIPTOR_TABLE);
SAME_VALUE(rtapi::RootParameterType::k32BitConstants, D3D12_ROOT_PARAMETER_TYPE_32BIT_CONSTANTS);
SAME_VALUE(rtapi::RootParameterType::kCbv, D3D12_ROOT_PARAMETER_TYPE_CBV);
SAME_VALUE(rtapi::RootParameterType::kSrv, D3D12_ROOT_PARAMETER_TYPE_SRV);
SAME_VALUE(rtapi::RootParameterType::kUav, D3D12_ROOT_PARAMETER_TYPE_UAV);

// D3D12_SHADER_VISIBILITY
SAME_VALUE(rtapi::ShaderVisibility::kAll, D3D12_SHADER_VISIBILITY_ALL);
SAME_VALUE(rtapi::ShaderVisibility::kVertex, D3D12_SHADER_VISIBILITY_VERTEX);
SAME_VALUE(rtapi::ShaderVisibility::kHull, D3D12_SHADER_VISIBILITY_HULL);
SAME_VALUE(rtapi::ShaderVisibility::kDomain, D3D12_SHADER_VISIBILITY_DOMAIN);
SAME_VALUE(rtapi::ShaderVisibility::kGeometry, D3D12_SHADER_VISIBILITY_GEOMETRY);
SAME_VALUE(rtapi::ShaderVisibility::kPixel, D3D12_SHADER_VISIBILITY_PIXEL);
SAME_VALUE(rtapi::ShaderVisibility::kAmplification, D3D12_SHADER_VISIBILITY_AMPLIFICATION);
SAME_VALUE(rtapi::ShaderVisibility::kMesh, D3D12_SHADER_VISIBILITY_MESH);

// D3D12_ROOT_SIGNATURE_FLAG
SAME_VALUE(rtapi::RootSignatureFlags::kNone, D3D12_ROOT_SIGNATURE_FLAG_NONE);
SAME_VALUE(rtapi::RootSignatureFlags::kAllowInputAssemblerInputLayout,
           D3D12_ROOT_SIGNATURE_FLAG_ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT);
SAME_VALUE(rtapi::RootSignatureFlags::kDenyVertexShaderRootAccess,
           D3D12_ROOT_SIGNATURE_FLAG_DENY_VERTEX_SHADER_ROOT_ACCESS);
SAME_VALUE(rtapi::RootSignatureFlags::kDenyHullShaderRootAccess,
           D3D12_ROOT_SIGNATURE_FLAG_DENY_HULL_SHADER_ROOT_ACCESS);
SAME_VALUE(rtapi::RootSignatureFlags::kDenyDomainShaderRootAccess,
           D3D12_ROOT_SIGNATURE_FLAG_DENY_DOMAIN_SHADER_ROOT_ACCESS);
SAME_VALUE(rtapi::RootSignatureFlags::kDenyGeometryShaderRootAccess,
           D3D12_ROOT_SIGNATURE_FLAG_DENY_GEOMETRY_SHADER_ROOT_ACCESS);
SAME_VALUE(rtapi::RootSignatureFlags::kDenyPixelShaderRootAccess,
           D3D12_ROOT_SIGNATURE_FLAG_DENY_PIXEL_SHADER_ROOT_ACCESS);
SAME_VALUE(rtapi::RootSignatureFlags::kAllowStreamOutput,
           D3D12_ROOT_SIGNATURE_FLAG_ALLOW_STREAM_OUTPUT);
SAME_VALUE(rtapi::RootSignatureFlags::kLocalRootSignature,
           D3D12_ROOT_SIGNATURE_FLAG_LOCAL_ROOT_SIGNATURE);
SAME_VALUE(rtapi::RootSignatureFlags::kDenyAmplificationShaderRootAccess,
           D3D12_ROOT_SIGNATURE_FLAG_DENY_AMPLIFICATION_SHADER_ROOT_ACCESS);
SAME_VALUE(rtapi::RootSignatureFlags::kDenyMeshShaderRootAccess,
           D3D12_ROOT_SIGNATURE_FLAG_DENY_MESH_SHADER_ROOT_ACCESS);
SAME_VALUE(rtapi::RootSignatureFlags::kCbvSrvUavHeapDirectlyIndexed,
           D3D12_ROOT_SIGNATURE_FLAG_CBV_SRV_UAV_HEAP_DIRECTLY_INDEXED);
SAME_VALUE(rtapi::RootSignatureFlags::kSamplerHeapDirectlyIndexed,
           D3D12_ROOT_SIGNATURE_FLAG_SAMPLER_HEAP_DIRECTLY_INDEXED);

// D3D12_STATE_OBJECT_TYPE
SAME_VALUE(rtapi::StateObjectType::kCollection, D3D12_STATE_OBJECT_TYPE_COLLECTION);
SAME_VALUE(rtapi::StateObjectType::kRaytracingPipeline,
           D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);

// D3D12_STATE_SUBOBJECT_TYPE
SAME_VALUE(rtapi::StateSubobjectType::kStateObjectConfig,
           D3D12_STATE_SUBOBJECT_TYPE_STATE_OBJECT_CONFIG);
SAME_VALUE(rtapi::StateSubobjectType::kGlobalRootSignature,
           D3D12_STATE_SUBOBJECT_TYPE_GLOBAL_ROOT_SIGNATURE);
SAME_VALUE(rtapi::StateSubobjectType::kLocalRootSignature,
           D3D12_STATE_SUBOBJECT_TYPE_LOCAL_ROOT_SIGNATURE);
SAME_VALUE(rtapi::StateSubobjectType::kNodeMask, D3D12_STATE_SUBOBJECT_TYPE_NODE_MASK);
SAME_VALUE(rtapi::StateSubobjectType::kDxilLibrary, D3D12_STATE_SUBOBJECT_TYPE_DXIL_LIBRARY);
SAME_VALUE(rtapi::StateSubobjectType::kExistingCollection,
           D3D12_STATE_SUBOBJECT_TYPE_EXISTING_COLLECTION);
SAME_VALUE(rtapi::StateSubobjectType::kSubobjectToExportsAssociation,
           D3D12_STATE_SUBOBJECT_TYPE_SUBOBJECT_TO_EXPORTS_ASSOCIATION);
SAME_VALUE(rtapi::StateSubobjectType::kDxilSubobjectToExportsAssociation,
           D3D12_STATE_SUBOBJECT_TYPE_DXIL_SUBOBJECT_TO_EXPORTS_ASSOCIATION);
SAME_VALUE(rtapi::StateSubobjectType::kRaytracingShaderConfig,
           D3D12_STATE_SUBOBJECT_TYPE_RAYTRACING_SHADER_CONFIG);
SAME_VALUE(rtapi::StateSubobjectType::kRaytracingPipelineConfig,
           D3D12_STATE_SUBOBJECT_TYPE_RAYTRACING_PIPELINE_CONFIG);
SAME_VALUE(rtapi::StateSubobjectType::kHitGroup, D3D12_STATE_SUBOBJECT_TYPE_HIT_GROUP);
SAME_VALUE(rtapi::StateSubobjectType::kRaytracingPipelineConfig1,
           D3D12_STATE_SUBOBJECT_TYPE_RAYTRACING_PIPELINE_CONFIG1);

// D3D12_STATE_OBJECT_FLAG
SAME_VALUE(rtapi::StateObjectFlags::kNone, D3D12_STATE_OBJECT_FLAG_NONE);
SAME_VALUE(rtapi::StateObjectFlags::kAllowLocalDependenciesOnExternalDefinitions,
           D3D12_STATE_OBJECT_FLAG_ALLOW_LOCAL_DEPENDENCIES_ON_EXTERNAL_DEFINITIONS);
SAME_VALUE(rtapi::StateObjectFlags::kAllowExternalDependenciesOnLocalDefinitions,
           D3D12_STATE_OBJECT_FLAG_ALLOW_EXTERNAL_DEPENDENCIES_ON_LOCAL_DEFINITIONS);
SAME_VALUE(rtapi::StateObjectFlags::kAllowStateObjectAdditions,
           D3D12_STATE_OBJECT_FLAG_ALLOW_STATE_OBJECT_ADDITIONS);

// D3D12_HIT_GROUP_TYPE
SAME_VALUE(rtapi::HitGroupType::kTriangles, D3D12_HIT_GROUP_TYPE_TRIANGLES);
SAME_VALUE(rtapi::HitGroupType::kProceduralPrimitive, D3D12_HIT_GROUP_TYPE_PROCEDURAL_PRIMITIVE);

// D3D12_RAYTRACING_PIPELINE_FLAG
SAME_VALUE(rtapi::RaytracingPipelineFlags::kNone, D3D12_RAYTRACING_PIPELINE_FLAG_NONE);
SAME_VALUE(rtapi::RaytracingPipelineFlags::kSkipTriangles,
           D3D12_RAYTRACING_PIPELINE_FLAG_SKIP_TRIANGLES);
SAME_VALUE(rtapi::RaytracingPipelineFlags::kSkipProceduralPrimitives,
           D3D12_RAYTRACING_PIPELINE_FLAG_SKIP_PROCEDURAL_PRIMITIVES);

// D3D12_BARRIER_SYNC
SAME_VALUE(rtapi::BarrierSync::kNone, D3D12_BARRIER_SYNC_NONE);
SAME_VALUE(rtapi::BarrierSync::kAll, D3D12_BARRIER_SYNC_ALL);
SAME_VALUE(rtapi::BarrierSync::kDraw, D3D12_BARRIER_SYNC_DRAW);
SAME_VALUE(rtapi::BarrierSync::kIndexInput, D3D12_BARRIER_SYNC_INPUT_ASSEMBLER);
SAME_VALUE(rtapi::BarrierSync::kVertexShading, D3D12_BARRIER_SYNC_VERTEX_SHADING);
SAME_VALUE(rtapi::BarrierSync::kPixelShading, D3D12_BARRIER_SYNC_PIXEL_SHADING);
SAME_VALUE(rtapi::BarrierSync::kDepthStencil, D3D12_BARRIER_SYNC_DEPTH_STENCIL);
SAME_VALUE(rtapi::BarrierSync::kRenderTarget, D3D12_BARRIER_SYNC_RENDER_TARGET);
SAME_VALUE(rtapi::BarrierSync::kComputeShading, D3D12_BARRIER_SYNC_COMPUTE_SHADING);
SAME_VALUE(rtapi::BarrierSync::kRaytracing, D3D12_BARRIER_SYNC_RAYTRACING);
SAME_VALUE(rtapi::BarrierSync::kCopy, D3D12_BARRIER_SYNC_COPY);
SAME_VALUE(rtapi::BarrierSync::kResolve, D3D12_BARRIER_SYNC_RESOLVE);
SAME_VALUE(rtapi::BarrierSync::kExecuteIndirect, D3D12_BARRIER_SYNC_EXECUTE_INDIRECT);
SAME_VALUE(rtapi::BarrierSync::kAllShading, D3D12_BARRIER_SYNC_ALL_SHADING);
SAME_VALUE(rtapi::BarrierSync::kNonPixelShading, D3D12_BARRIER_SYNC_NON_PIXEL_SHADING);
SAME_VALUE(rtapi::BarrierSync::kEmitPostbuildInfo,
           D3D12_BARRIER_SYNC_EMIT_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO);
SAME_VALUE(rtapi::BarrierSync::kClearUnorderedAccessView,
           D3D12_BARRIER_SYNC_CLEAR_UNORDERED_ACCESS_VIEW);
SAME_VALUE(rtapi::BarrierSync::kBuildAccelerationStructure,
           D3D12_BARRIER_SYNC_BUILD_RAYTRACING_ACCELERATION_STRUCTURE);
SAME_VALUE(rtapi::BarrierSync::kCopyAccelerationStructure,
           D3D12_BARRIER_SYNC_COPY_RAYTRACING_ACCELERATION_STRUCTURE);
SAME_VALUE(rtapi::BarrierSync::kSplit, D3D12_BARRIER_SYNC_SPLIT);

// D3D12_BARRIER_ACCESS
SAME_VALUE(rtapi::BarrierAccess::kCommon, D3D12_BARRIER_ACCESS_COMMON);
SAME_VALUE(rtapi::BarrierAccess::kVertexBuffer, D3D12_BARRIER_ACCESS_VERTEX_BUFFER);
SAME_VALUE(rtapi::BarrierAccess::kConstantBuffer, D3D12_BARRIER_ACCESS_CONSTANT_BUFFER);
SAME_VALUE(rtapi::BarrierAccess::kIndexBuffer, D3D12_BARRIER_ACCESS_INDEX_BUFFER);
SAME_VALUE(rtapi::BarrierAccess::kRenderTarget, D3D12_BARRIER_ACCESS_RENDER_TARGET);
SAME_VALUE(rtapi::BarrierAccess::kUnorderedAccess, D3D12_BARRIER_ACCESS_UNORDERED_ACCESS);
SAME_VALUE(rtapi::BarrierAccess::kDepthStencilWrite, D3D12_BARRIER_ACCESS_DEPTH_STENCIL_WRITE);
SAME_VALUE(rtapi::BarrierAccess::kDepthStencilRead, D3D12_BARRIER_ACCESS_DEPTH_STENCIL_READ);
SAME_VALUE(rtapi::BarrierAccess::kShaderResource, D3D12_BARRIER_ACCESS_SHADER_RESOURCE);
SAME_VALUE(rtapi::BarrierAccess::kStreamOutput, D3D12_BARRIER_ACCESS_STREAM_OUTPUT);
SAME_VALUE(rtapi::BarrierAccess::kIndirectArgument, D3D12_BARRIER_ACCESS_INDIRECT_ARGUMENT);
SAME_VALUE(rtapi::BarrierAccess::kCopyDest, D3D12_BARRIER_ACCESS_COPY_DEST);
SAME_VALUE(rtapi::BarrierAccess::kCopySource, D3D12_BARRIER_ACCESS_COPY_SOURCE);
SAME_VALUE(rtapi::BarrierAccess::kResolveDest, D3D12_BARRIER_ACCESS_RESOLVE_DEST);
SAME_VALUE(rtapi::BarrierAccess::kResolveSource, D3D12_BARRIER_ACCESS_RESOLVE_SOURCE);
SAME_VALUE(rtapi::BarrierAccess::kAccelerationStructureRead,
           D3D12_BARRIER_ACCESS_RAYTRACING_ACCELERATION_STRUCTURE_READ);
SAME_VALUE(rtapi::BarrierAccess::kAccelerationStructureWrite,
           D3D12_BARRIER_ACCESS_RAYTRACING_ACCELERATION_STRUCTURE_WRITE);
SAME_VALUE(rtapi::BarrierAccess::kNoAccess, D3D12_BARRIER_ACCESS_NO_ACCESS);

// D3D12_BARRIER_LAYOUT
SAME_VALUE(rtapi::BarrierLayout::kUndefined, D3D12_BARRIER_LAYOUT_UNDEFINED);
SAME_VALUE(rtapi::BarrierLayout::kCommon, D3D12_BARRIER_LAYOUT_COMMON);
SAME_VALUE(rtapi::BarrierLayout::kGenericRead, D3D12_BARRIER_LAYOUT_GENERIC_READ);
SAME_VALUE(rtapi::BarrierLayout::kRenderTarget, D3D12_BARRIER_LAYOUT_RENDER_TARGET);
SAME_VALUE(rtapi::BarrierLayout::kUnorderedAccess, D3D12_BARRIER_LAYOUT_UNORDERED_ACCESS);
SAME_VALUE(rtapi::BarrierLayout::kDepthStencilWrite, D3D12_BARRIER_LAYOUT_DEPTH_STENCIL_WRITE);
SAME_VALUE(rtapi::BarrierLayout::kDepthStencilRead, D3D12_BARRIER_LAYOUT_DEPTH_STENCIL_READ);
SAME_VALUE(rtapi::BarrierLayout::kShaderResource, D3D12_BARRIER_LAYOUT_SHADER_RESOURCE);
SAME_VALUE(rtapi::BarrierLayout::kCopySource, D3D12_BARRIER_LAYOUT_COPY_SOURCE);
SAME_VALUE(rtapi::BarrierLayout::kCopyDest, D3D12_BARRIER_LAYOUT_COPY_DEST);
SAME_VALUE(rtapi::BarrierLayout::kResolveSource, D3D12_BARRIER_LAYOUT_RESOLVE_SOURCE);
SAME_VALUE(rtapi::BarrierLayout::kResolveDest, D3D12_BARRIER_LAYOUT_RESOLVE_DEST);
SAME_VALUE(rtapi::BarrierLayout::kDirectQueueCommon, D3D12_BARRIER_LAYOUT_DIRECT_QUEUE_COMMON);
SAME_VALUE(rtapi::BarrierLayout::kDirectQueueGenericRead,
           D3D12_BARRIER_LAYOUT_DIRECT_QUEUE_GENERIC_READ);
SAME_VALUE(rtapi::BarrierLayout::kDirectQueueUnorderedAccess,
           D3D12_BARRIER_LAYOUT_DIRECT_QUEUE_UNORDERED_ACCESS);
SAME_VALUE(rtapi::BarrierLayout::kDirectQueueShaderResource,
           D3D12_BARRIER_LAYOUT_DIRECT_QUEUE_SHADER_RESOURCE);
SAME_VALUE(rtapi::BarrierLayout::kDirectQueueCopySource,
           D3D12_BARRIER_LAYOUT_DIRECT_QUEUE_COPY_SOURCE);
SAME_VALUE(rtapi::BarrierLayout::kDirectQueueCopyDest, D3D12_BARRIER_LAYOUT_DIRECT_QUEUE_COPY_DEST);
SAME_VALUE(rtapi::BarrierLayout::kComputeQueueCommon, D3D12_BARRIER_LAYOUT_COMPUTE_QUEUE_COMMON);
SAME_VALUE(rtapi::BarrierLayout::kComputeQueueGenericRead,
           D3D12_BARRIER_LAYOUT_COMPUTE_QUEUE_GENERIC_READ);
SAME_VALUE(rtapi::BarrierLayout::kComputeQueueUnorderedAccess,
           D3D12_BARRIER_LAYOUT_COMPUTE_QUEUE_UNORDERED_ACCESS);
SAME_VALUE(rtapi::BarrierLayout::kComputeQueueShaderResource,
           D3D12_BARRIER_LAYOUT_COMPUTE_QUEUE_SHADER_RESOURCE);
SAME_VALUE(rtapi::BarrierLayout::kComputeQueueCopySource,
           D3D12_BARRIER_LAYOUT_COMPUTE_QUEUE_COPY_SOURCE);
SAME_VALUE(rtapi::BarrierLayout::kComputeQueueCopyDest,
           D3D12_BARRIER_LAYOUT_COMPUTE_QUEUE_COPY_DEST);

// D3D12_TEXTURE_BARRIER_FLAG
SAME_VALUE(rtapi::TextureBarrierFlags::kNone, D3D12_TEXTURE_BARRIER_FLAG_NONE);
SAME_VALUE(rtapi::TextureBarrierFlags::kDiscard, D3D12_TEXTURE_BARRIER_FLAG_DISCARD);

constexpr int kChecks = __COUNTER__ - kFirst - 1;

}  // namespace

int layout_numbers() {
  return kChecks;
}

}  // namespace rtapi::testing
