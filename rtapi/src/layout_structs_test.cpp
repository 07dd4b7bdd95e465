// SPDX-License-Identifier: MIT
//
// Structures, but for graphics pipelines.
#include "rtapi/testing/same_layout.h"

namespace rtapi::testing {
namespace {

constexpr int kFirst = __COUNTER__;

SAME_SIZE(RaytracingInstanceDesc, D3D12_RAYTRACING_INSTANCE_DESC);
SAME_OFFSET(RaytracingInstanceDesc, D3D12_RAYTRACING_INSTANCE_DESC, Transform);
SAME_OFFSET(RaytracingInstanceDesc, D3D12_RAYTRACING_INSTANCE_DESC, AccelerationStructure);
SAME_SIZE(RaytracingAabb, D3D12_RAYTRACING_AABB);
SAME_OFFSET(RaytracingAabb, D3D12_RAYTRACING_AABB, MinX);
SAME_OFFSET(RaytracingAabb, D3D12_RAYTRACING_AABB, MinY);
SAME_OFFSET(RaytracingAabb, D3D12_RAYTRACING_AABB, MinZ);
SAME_OFFSET(RaytracingAabb, D3D12_RAYTRACING_AABB, MaxX);
SAME_OFFSET(RaytracingAabb, D3D12_RAYTRACING_AABB, MaxY);
SAME_OFFSET(RaytracingAabb, D3D12_RAYTRACING_AABB, MaxZ);
SAME_SIZE(RaytracingGeometryTrianglesDesc, D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC);
SAME_OFFSET(RaytracingGeometryTrianglesDesc, D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC,
            Transform3x4);
SAME_OFFSET(RaytracingGeometryTrianglesDesc, D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC, IndexFormat);
SAME_OFFSET(RaytracingGeometryTrianglesDesc, D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC,
            VertexFormat);
SAME_OFFSET(RaytracingGeometryTrianglesDesc, D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC, IndexCount);
SAME_OFFSET(RaytracingGeometryTrianglesDesc, D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC, VertexCount);
SAME_OFFSET(RaytracingGeometryTrianglesDesc, D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC, IndexBuffer);
SAME_OFFSET(RaytracingGeometryTrianglesDesc, D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC,
            VertexBuffer);
SAME_SIZE(RaytracingGeometryAabbsDesc, D3D12_RAYTRACING_GEOMETRY_AABBS_DESC);
SAME_OFFSET(RaytracingGeometryAabbsDesc, D3D12_RAYTRACING_GEOMETRY_AABBS_DESC, AABBCount);
SAME_OFFSET(RaytracingGeometryAabbsDesc, D3D12_RAYTRACING_GEOMETRY_AABBS_DESC, AABBs);
SAME_SIZE(RaytracingGeometryDesc, D3D12_RAYTRACING_GEOMETRY_DESC);
SAME_OFFSET(RaytracingGeometryDesc, D3D12_RAYTRACING_GEOMETRY_DESC, Type);
SAME_OFFSET(RaytracingGeometryDesc, D3D12_RAYTRACING_GEOMETRY_DESC, Flags);
SAME_OFFSET(RaytracingGeometryDesc, D3D12_RAYTRACING_GEOMETRY_DESC, Triangles);
SAME_OFFSET(RaytracingGeometryDesc, D3D12_RAYTRACING_GEOMETRY_DESC, AABBs);
SAME_SIZE(BuildRaytracingAccelerationStructureInputs,
          D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS);
SAME_OFFSET(BuildRaytracingAccelerationStructureInputs,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS, Type);
SAME_OFFSET(BuildRaytracingAccelerationStructureInputs,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS, Flags);
SAME_OFFSET(BuildRaytracingAccelerationStructureInputs,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS, NumDescs);
SAME_OFFSET(BuildRaytracingAccelerationStructureInputs,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS, DescsLayout);
SAME_OFFSET(BuildRaytracingAccelerationStructureInputs,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS, InstanceDescs);
SAME_OFFSET(BuildRaytracingAccelerationStructureInputs,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS, pGeometryDescs);
SAME_OFFSET(BuildRaytracingAccelerationStructureInputs,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS, ppGeometryDescs);
SAME_SIZE(BuildRaytracingAccelerationStructureDesc,
          D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC);
SAME_OFFSET(BuildRaytracingAccelerationStructureDesc,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC, DestAccelerationStructureData);
SAME_OFFSET(BuildRaytracingAccelerationStructureDesc,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC, Inputs);
SAME_OFFSET(BuildRaytracingAccelerationStructureDesc,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC, SourceAccelerationStructureData);
SAME_OFFSET(BuildRaytracingAccelerationStructureDesc,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC, ScratchAccelerationStructureData);
SAME_SIZE(RaytracingAccelerationStructurePrebuildInfo,
          D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO);
SAME_OFFSET(RaytracingAccelerationStructurePrebuildInfo,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO, ResultDataMaxSizeInBytes);
SAME_OFFSET(RaytracingAccelerationStructurePrebuildInfo,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO, ScratchDataSizeInBytes);
SAME_OFFSET(RaytracingAccelerationStructurePrebuildInfo,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO, UpdateScratchDataSizeInBytes);
SAME_SIZE(RaytracingAccelerationStructurePostbuildInfoDesc,
          D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC);
SAME_OFFSET(RaytracingAccelerationStructurePostbuildInfoDesc,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC, DestBuffer);
SAME_OFFSET(RaytracingAccelerationStructurePostbuildInfoDesc,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC, InfoType);
SAME_SIZE(RaytracingAccelerationStructurePostbuildInfoCompactedSizeDesc,
          D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_COMPACTED_SIZE_DESC);
SAME_OFFSET(RaytracingAccelerationStructurePostbuildInfoCompactedSizeDesc,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_COMPACTED_SIZE_DESC,
            CompactedSizeInBytes);
SAME_SIZE(RaytracingAccelerationStructurePostbuildInfoToolsVisualizationDesc,
          D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_TOOLS_VISUALIZATION_DESC);
SAME_OFFSET(RaytracingAccelerationStructurePostbuildInfoToolsVisualizationDesc,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_TOOLS_VISUALIZATION_DESC,
            DecodedSizeInBytes);
SAME_SIZE(RaytracingAccelerationStructurePostbuildInfoSerializationDesc,
          D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_SERIALIZATION_DESC);
SAME_OFFSET(RaytracingAccelerationStructurePostbuildInfoSerializationDesc,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_SERIALIZATION_DESC,
            SerializedSizeInBytes);
SAME_OFFSET(RaytracingAccelerationStructurePostbuildInfoSerializationDesc,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_SERIALIZATION_DESC,
            NumBottomLevelAccelerationStructurePointers);
SAME_SIZE(RaytracingAccelerationStructurePostbuildInfoCurrentSizeDesc,
          D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_CURRENT_SIZE_DESC);
SAME_OFFSET(RaytracingAccelerationStructurePostbuildInfoCurrentSizeDesc,
            D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_CURRENT_SIZE_DESC,
            CurrentSizeInBytes);
SAME_SIZE(Guid, GUID);
SAME_OFFSET(Guid, GUID, Data1);
SAME_OFFSET(Guid, GUID, Data2);
SAME_OFFSET(Guid, GUID, Data3);
SAME_OFFSET(Guid, GUID, Data4);
SAME_SIZE(SerializedDataDriverMatchingIdentifier, D3D12_SERIALIZED_DATA_DRIVER_MATCHING_IDENTIFIER);
SAME_OFFSET(SerializedDataDriverMatchingIdentifier,
            D3D12_SERIALIZED_DATA_DRIVER_MATCHING_IDENTIFIER, DriverOpaqueGUID);
SAME_OFFSET(SerializedDataDriverMatchingIdentifier,
            D3D12_SERIALIZED_DATA_DRIVER_MATCHING_IDENTIFIER, DriverOpaqueVersioningData);
SAME_SIZE(SerializedRaytracingAccelerationStructureHeader,
          D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER);
SAME_OFFSET(SerializedRaytracingAccelerationStructureHeader,
            D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER, DriverMatchingIdentifier);
SAME_OFFSET(SerializedRaytracingAccelerationStructureHeader,
            D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER,
            SerializedSizeInBytesIncludingHeader);
SAME_OFFSET(SerializedRaytracingAccelerationStructureHeader,
            D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER, DeserializedSizeInBytes);
SAME_OFFSET(SerializedRaytracingAccelerationStructureHeader,
            D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER,
            NumBottomLevelAccelerationStructurePointersAfterHeader);
SAME_SIZE(BuildRaytracingAccelerationStructureToolsVisualizationHeader,
          D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_TOOLS_VISUALIZATION_HEADER);
SAME_OFFSET(BuildRaytracingAccelerationStructureToolsVisualizationHeader,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_TOOLS_VISUALIZATION_HEADER, Type);
SAME_OFFSET(BuildRaytracingAccelerationStructureToolsVisualizationHeader,
            D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_TOOLS_VISUALIZATION_HEADER, NumDescs);
SAME_VALUE(rtapi::DriverMatchingIdentifierStatus::kCompatibleWithDevice,
           D3D12_DRIVER_MATCHING_IDENTIFIER_COMPATIBLE_WITH_DEVICE);
SAME_VALUE(rtapi::DriverMatchingIdentifierStatus::kUnsupportedType,
           D3D12_DRIVER_MATCHING_IDENTIFIER_UNSUPPORTED_TYPE);
SAME_VALUE(rtapi::DriverMatchingIdentifierStatus::kUnrecognized,
           D3D12_DRIVER_MATCHING_IDENTIFIER_UNRECOGNIZED);
SAME_VALUE(rtapi::DriverMatchingIdentifierStatus::kIncompatibleVersion,
           D3D12_DRIVER_MATCHING_IDENTIFIER_INCOMPATIBLE_VERSION);
SAME_VALUE(rtapi::DriverMatchingIdentifierStatus::kIncompatibleType,
           D3D12_DRIVER_MATCHING_IDENTIFIER_INCOMPATIBLE_TYPE);
SAME_VALUE(rtapi::SerializedDataType::kRaytracingAccelerationStructure,
           D3D12_SERIALIZED_DATA_RAYTRACING_ACCELERATION_STRUCTURE);
// Command signatures
SAME_VALUE(rtapi::IndirectArgumentType::kDraw, D3D12_INDIRECT_ARGUMENT_TYPE_DRAW);
SAME_VALUE(rtapi::IndirectArgumentType::kDrawIndexed, D3D12_INDIRECT_ARGUMENT_TYPE_DRAW_INDEXED);
SAME_VALUE(rtapi::IndirectArgumentType::kDispatch, D3D12_INDIRECT_ARGUMENT_TYPE_DISPATCH);
SAME_VALUE(rtapi::IndirectArgumentType::kVertexBufferView,
           D3D12_INDIRECT_ARGUMENT_TYPE_VERTEX_BUFFER_VIEW);
SAME_VALUE(rtapi::IndirectArgumentType::kIndexBufferView,
           D3D12_INDIRECT_ARGUMENT_TYPE_INDEX_BUFFER_VIEW);
SAME_VALUE(rtapi::IndirectArgumentType::kConstant, D3D12_INDIRECT_ARGUMENT_TYPE_CONSTANT);
SAME_VALUE(rtapi::IndirectArgumentType::kConstantBufferView,
           D3D12_INDIRECT_ARGUMENT_TYPE_CONSTANT_BUFFER_VIEW);
SAME_VALUE(rtapi::IndirectArgumentType::kShaderResourceView,
           D3D12_INDIRECT_ARGUMENT_TYPE_SHADER_RESOURCE_VIEW);
SAME_VALUE(rtapi::IndirectArgumentType::kUnorderedAccessView,
           D3D12_INDIRECT_ARGUMENT_TYPE_UNORDERED_ACCESS_VIEW);
SAME_VALUE(rtapi::IndirectArgumentType::kDispatchRays, D3D12_INDIRECT_ARGUMENT_TYPE_DISPATCH_RAYS);
SAME_VALUE(rtapi::IndirectArgumentType::kDispatchMesh, D3D12_INDIRECT_ARGUMENT_TYPE_DISPATCH_MESH);
SAME_SIZE(IndirectArgumentDesc, D3D12_INDIRECT_ARGUMENT_DESC);
SAME_OFFSET(IndirectArgumentDesc, D3D12_INDIRECT_ARGUMENT_DESC, Type);
SAME_OFFSET(IndirectArgumentDesc, D3D12_INDIRECT_ARGUMENT_DESC, Constant);
SAME_OFFSET(IndirectArgumentDesc, D3D12_INDIRECT_ARGUMENT_DESC, Constant.DestOffsetIn32BitValues);
SAME_OFFSET(IndirectArgumentDesc, D3D12_INDIRECT_ARGUMENT_DESC, Constant.Num32BitValuesToSet);
SAME_OFFSET(IndirectArgumentDesc, D3D12_INDIRECT_ARGUMENT_DESC, VertexBuffer);
SAME_OFFSET(IndirectArgumentDesc, D3D12_INDIRECT_ARGUMENT_DESC, ConstantBufferView);
SAME_OFFSET(IndirectArgumentDesc, D3D12_INDIRECT_ARGUMENT_DESC, ShaderResourceView);
SAME_OFFSET(IndirectArgumentDesc, D3D12_INDIRECT_ARGUMENT_DESC, UnorderedAccessView);
SAME_SIZE(DispatchArguments, D3D12_DISPATCH_ARGUMENTS);
SAME_OFFSET(DispatchArguments, D3D12_DISPATCH_ARGUMENTS, ThreadGroupCountX);
SAME_OFFSET(DispatchArguments, D3D12_DISPATCH_ARGUMENTS, ThreadGroupCountY);
SAME_OFFSET(DispatchArguments, D3D12_DISPATCH_ARGUMENTS, ThreadGroupCountZ);
SAME_SIZE(DispatchRaysDesc, D3D12_DISPATCH_RAYS_DESC);
SAME_OFFSET(DispatchRaysDesc, D3D12_DISPATCH_RAYS_DESC, RayGenerationShaderRecord);
SAME_OFFSET(DispatchRaysDesc, D3D12_DISPATCH_RAYS_DESC, MissShaderTable);
SAME_OFFSET(DispatchRaysDesc, D3D12_DISPATCH_RAYS_DESC, HitGroupTable);
SAME_OFFSET(DispatchRaysDesc, D3D12_DISPATCH_RAYS_DESC, CallableShaderTable);
SAME_OFFSET(DispatchRaysDesc, D3D12_DISPATCH_RAYS_DESC, Width);
SAME_OFFSET(DispatchRaysDesc, D3D12_DISPATCH_RAYS_DESC, Height);
SAME_OFFSET(DispatchRaysDesc, D3D12_DISPATCH_RAYS_DESC, Depth);
SAME_SIZE(GpuVirtualAddressRange, D3D12_GPU_VIRTUAL_ADDRESS_RANGE);
SAME_OFFSET(GpuVirtualAddressRange, D3D12_GPU_VIRTUAL_ADDRESS_RANGE, StartAddress);
SAME_OFFSET(GpuVirtualAddressRange, D3D12_GPU_VIRTUAL_ADDRESS_RANGE, SizeInBytes);
SAME_SIZE(GpuVirtualAddressAndStride, D3D12_GPU_VIRTUAL_ADDRESS_AND_STRIDE);
SAME_OFFSET(GpuVirtualAddressAndStride, D3D12_GPU_VIRTUAL_ADDRESS_AND_STRIDE, StartAddress);
SAME_OFFSET(GpuVirtualAddressAndStride, D3D12_GPU_VIRTUAL_ADDRESS_AND_STRIDE, StrideInBytes);
SAME_SIZE(GpuVirtualAddressRangeAndStride, D3D12_GPU_VIRTUAL_ADDRESS_RANGE_AND_STRIDE);
SAME_OFFSET(GpuVirtualAddressRangeAndStride, D3D12_GPU_VIRTUAL_ADDRESS_RANGE_AND_STRIDE,
            StartAddress);
SAME_OFFSET(GpuVirtualAddressRangeAndStride, D3D12_GPU_VIRTUAL_ADDRESS_RANGE_AND_STRIDE,
            SizeInBytes);
SAME_OFFSET(GpuVirtualAddressRangeAndStride, D3D12_GPU_VIRTUAL_ADDRESS_RANGE_AND_STRIDE,
            StrideInBytes);
SAME_SIZE(CpuDescriptorHandle, D3D12_CPU_DESCRIPTOR_HANDLE);
SAME_OFFSET(CpuDescriptorHandle, D3D12_CPU_DESCRIPTOR_HANDLE, ptr);
SAME_SIZE(GpuDescriptorHandle, D3D12_GPU_DESCRIPTOR_HANDLE);
SAME_OFFSET(GpuDescriptorHandle, D3D12_GPU_DESCRIPTOR_HANDLE, ptr);
SAME_SIZE(RaytracingShaderConfig, D3D12_RAYTRACING_SHADER_CONFIG);
SAME_OFFSET(RaytracingShaderConfig, D3D12_RAYTRACING_SHADER_CONFIG, MaxPayloadSizeInBytes);
SAME_OFFSET(RaytracingShaderConfig, D3D12_RAYTRACING_SHADER_CONFIG, MaxAttributeSizeInBytes);
SAME_SIZE(RaytracingPipelineConfig, D3D12_RAYTRACING_PIPELINE_CONFIG);
SAME_OFFSET(RaytracingPipelineConfig, D3D12_RAYTRACING_PIPELINE_CONFIG, MaxTraceRecursionDepth);
SAME_SIZE(RaytracingPipelineConfig1, D3D12_RAYTRACING_PIPELINE_CONFIG1);
SAME_OFFSET(RaytracingPipelineConfig1, D3D12_RAYTRACING_PIPELINE_CONFIG1, MaxTraceRecursionDepth);
SAME_OFFSET(RaytracingPipelineConfig1, D3D12_RAYTRACING_PIPELINE_CONFIG1, Flags);
SAME_SIZE(DescriptorRange, D3D12_DESCRIPTOR_RANGE1);
SAME_OFFSET(DescriptorRange, D3D12_DESCRIPTOR_RANGE1, RangeType);
SAME_OFFSET(DescriptorRange, D3D12_DESCRIPTOR_RANGE1, NumDescriptors);
SAME_OFFSET(DescriptorRange, D3D12_DESCRIPTOR_RANGE1, BaseShaderRegister);
SAME_OFFSET(DescriptorRange, D3D12_DESCRIPTOR_RANGE1, RegisterSpace);
SAME_OFFSET(DescriptorRange, D3D12_DESCRIPTOR_RANGE1, Flags);
SAME_OFFSET(DescriptorRange, D3D12_DESCRIPTOR_RANGE1, OffsetInDescriptorsFromTableStart);
SAME_SIZE(RootConstants, D3D12_ROOT_CONSTANTS);
SAME_OFFSET(RootConstants, D3D12_ROOT_CONSTANTS, ShaderRegister);
SAME_OFFSET(RootConstants, D3D12_ROOT_CONSTANTS, RegisterSpace);
SAME_OFFSET(RootConstants, D3D12_ROOT_CONSTANTS, Num32BitValues);
SAME_SIZE(RootDescriptor, D3D12_ROOT_DESCRIPTOR1);
SAME_OFFSET(RootDescriptor, D3D12_ROOT_DESCRIPTOR1, ShaderRegister);
SAME_OFFSET(RootDescriptor, D3D12_ROOT_DESCRIPTOR1, RegisterSpace);
SAME_OFFSET(RootDescriptor, D3D12_ROOT_DESCRIPTOR1, Flags);
static_assert(sizeof(StaticSamplerDesc) == sizeof(D3D12_STATIC_SAMPLER_DESC) + sizeof(UINT));
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, Filter);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, AddressU);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, AddressV);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, AddressW);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, MipLODBias);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, MaxAnisotropy);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, ComparisonFunc);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, BorderColor);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, MinLOD);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, MaxLOD);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, ShaderRegister);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, RegisterSpace);
SAME_OFFSET(StaticSamplerDesc, D3D12_STATIC_SAMPLER_DESC, ShaderVisibility);
static_assert(offsetof(StaticSamplerDesc, Flags) == sizeof(D3D12_STATIC_SAMPLER_DESC));
SAME_SIZE(SamplerDesc, D3D12_SAMPLER_DESC);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, Filter);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, AddressU);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, AddressV);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, AddressW);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, MipLODBias);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, MaxAnisotropy);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, ComparisonFunc);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, BorderColor);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, MinLOD);
SAME_OFFSET(SamplerDesc, D3D12_SAMPLER_DESC, MaxLOD);
SAME_SIZE(ConstantBufferViewDesc, D3D12_CONSTANT_BUFFER_VIEW_DESC);
SAME_OFFSET(ConstantBufferViewDesc, D3D12_CONSTANT_BUFFER_VIEW_DESC, BufferLocation);
SAME_OFFSET(ConstantBufferViewDesc, D3D12_CONSTANT_BUFFER_VIEW_DESC, SizeInBytes);
SAME_SIZE(SubresourceFootprint, D3D12_SUBRESOURCE_FOOTPRINT);
SAME_OFFSET(SubresourceFootprint, D3D12_SUBRESOURCE_FOOTPRINT, Format);
SAME_OFFSET(SubresourceFootprint, D3D12_SUBRESOURCE_FOOTPRINT, Width);
SAME_OFFSET(SubresourceFootprint, D3D12_SUBRESOURCE_FOOTPRINT, Height);
SAME_OFFSET(SubresourceFootprint, D3D12_SUBRESOURCE_FOOTPRINT, Depth);
SAME_OFFSET(SubresourceFootprint, D3D12_SUBRESOURCE_FOOTPRINT, RowPitch);
SAME_SIZE(PlacedSubresourceFootprint, D3D12_PLACED_SUBRESOURCE_FOOTPRINT);
SAME_OFFSET(PlacedSubresourceFootprint, D3D12_PLACED_SUBRESOURCE_FOOTPRINT, Offset);
SAME_OFFSET(PlacedSubresourceFootprint, D3D12_PLACED_SUBRESOURCE_FOOTPRINT, Footprint);
SAME_SIZE(Box, D3D12_BOX);
SAME_OFFSET(Box, D3D12_BOX, left);
SAME_OFFSET(Box, D3D12_BOX, top);
SAME_OFFSET(Box, D3D12_BOX, front);
SAME_OFFSET(Box, D3D12_BOX, right);
SAME_OFFSET(Box, D3D12_BOX, bottom);
SAME_OFFSET(Box, D3D12_BOX, back);

constexpr int kChecks = __COUNTER__ - kFirst - 1;

}  // namespace

int layout_structs() {
  return kChecks;
}

}  // namespace rtapi::testing
