// SPDX-License-Identifier: MIT
/// @file
/// Constants, addresses and handles that every other header uses. Names, numbers and layouts are
/// those of d3d12.h; rtapi/src/layout_test.cpp compares them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <rtapi/flags.h>
#include <rtapi/format.h>

/// DirectX Raytracing: the calls, structures and numbers of D3D12 and DXR. Start at Device.
namespace rtapi {

/// An address in GPU memory, in bytes. 0 is no address. [D3D12: D3D12_GPU_VIRTUAL_ADDRESS]
using GpuVirtualAddress = uint64_t;

/// Bytes of a shader identifier, the first part of every shader record. [DXR: Constants]
inline constexpr uint32_t kShaderIdentifierSizeInBytes = 32;
/// The stride of a shader table is a multiple of this, in bytes. [DXR: Constants]
inline constexpr uint32_t kRaytracingShaderRecordByteAlignment = 32;
/// Every shader table, and the ray generation record, starts at a multiple of this, in bytes.
/// [DXR: Constants]
inline constexpr uint32_t kRaytracingShaderTableByteAlignment = 64;
/// Largest stride of a shader table, in bytes. [DXR: Shader record stride]
inline constexpr uint32_t kRaytracingMaxShaderRecordStride = 4096;
/// Alignment of acceleration structures, of their scratch memory and of serialized data, in bytes.
/// [DXR: Constants]
inline constexpr uint32_t kRaytracingAccelerationStructureByteAlignment = 256;
/// Alignment of instance descs in GPU memory, in bytes. [DXR: Constants]
inline constexpr uint32_t kRaytracingInstanceDescsByteAlignment = 16;
/// Alignment of RaytracingGeometryTrianglesDesc::Transform3x4, in bytes. [DXR: Constants]
inline constexpr uint32_t kRaytracingTransform3x4ByteAlignment = 16;
/// Alignment of the address and the stride of AABBs, in bytes. [DXR: Constants]
inline constexpr uint32_t kRaytracingAabbByteAlignment = 8;
/// Alignment of opacity micromap arrays and of their input buffers.
/// [D3D12: D3D12_RAYTRACING_OPACITY_MICROMAP_ARRAY_BYTE_ALIGNMENT]
inline constexpr uint32_t kRaytracingOpacityMicromapArrayByteAlignment = 128;
/// The highest level of an opacity micromap: 4^12 micro-triangles.
/// [D3D12: D3D12_RAYTRACING_OPACITY_MICROMAP_OC1_MAX_SUBDIVISION_LEVEL]
inline constexpr uint32_t kRaytracingOpacityMicromapMaxSubdivisionLevel = 12;
/// Largest value of RaytracingShaderConfig::MaxAttributeSizeInBytes. [DXR: Constants]
inline constexpr uint32_t kRaytracingMaxAttributeSizeInBytes = 32;
/// Largest recursion depth that a pipeline can declare. [DXR: Ray recursion limit]
inline constexpr uint32_t kRaytracingMaxDeclarableTraceRecursionDepth = 31;
/// Most threads of one DispatchRays: Width * Height * Depth. [DXR: DispatchRays]
inline constexpr uint32_t kRaytracingMaxRayGenerationShaderThreads = 1u << 30;
/// Most geometries of a bottom level. [DXR: Geometry limits]
inline constexpr uint32_t kRaytracingMaxGeometriesPerBottomLevelAccelerationStructure = 1u << 24;
/// Most instances of a top level. [DXR: Geometry limits]
inline constexpr uint32_t kRaytracingMaxInstancesPerTopLevelAccelerationStructure = 1u << 24;
/// Most primitives of a bottom level, over all its geometries. [DXR: Geometry limits]
inline constexpr uint32_t kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure = 1u << 29;
/// Most bytes of local root arguments: the largest stride without the shader identifier.
/// [DXR: Local root signatures vs global root signatures]
inline constexpr uint32_t kMaxLocalRootArgumentBytes = 4064;

/// Most DWORDs of a global root signature: a table costs 1, a root descriptor 2, each constant 1.
/// [D3D12: root signature limits]
inline constexpr uint32_t kMaxRootCost = 64;
/// SubresourceFootprint::RowPitch is a multiple of this, in bytes.
/// [D3D12: D3D12_TEXTURE_DATA_PITCH_ALIGNMENT]
inline constexpr uint32_t kTextureDataPitchAlignment = 256;
/// PlacedSubresourceFootprint::Offset is a multiple of this, in bytes.
/// [D3D12: D3D12_TEXTURE_DATA_PLACEMENT_ALIGNMENT]
inline constexpr uint32_t kTextureDataPlacementAlignment = 512;
/// Alignment of the address and the size of constant buffers, in bytes.
/// [D3D12: D3D12_CONSTANT_BUFFER_DATA_PLACEMENT_ALIGNMENT]
inline constexpr uint32_t kConstantBufferDataPlacementAlignment = 256;
/// A raw view starts at a multiple of this, in bytes. [D3D12: D3D12_RAW_UAV_SRV_BYTE_ALIGNMENT]
inline constexpr uint32_t kRawUavSrvByteAlignment = 16;
/// Largest width of a 1-D texture, in texels. [D3D12: D3D12_REQ_TEXTURE1D_U_DIMENSION]
inline constexpr uint32_t kReqTexture1DUDimension = 16384;
/// Largest width and height of a 2-D texture, in texels.
/// [D3D12: D3D12_REQ_TEXTURE2D_U_OR_V_DIMENSION]
inline constexpr uint32_t kReqTexture2DUOrVDimension = 16384;
/// Largest width, height and depth of a 3-D texture, in texels.
/// [D3D12: D3D12_REQ_TEXTURE3D_U_V_OR_W_DIMENSION]
inline constexpr uint32_t kReqTexture3DUVOrWDimension = 2048;
/// Most elements of a texture array. [D3D12: D3D12_REQ_TEXTURE2D_ARRAY_AXIS_DIMENSION]
inline constexpr uint32_t kReqTexture2DArrayAxisDimension = 2048;
/// Most thread groups of a Dispatch in each dimension. [D3D12: Dispatch]
inline constexpr uint32_t kCsDispatchMaxThreadGroupsPerDimension = 65535;
/// Most descriptors of a shader-visible sampler heap. [D3D12: hardware tiers]
inline constexpr uint32_t kMaxShaderVisibleSamplerHeapSize = 2048;
/// Most descriptors of a heap of views. [D3D12: hardware tiers]
inline constexpr uint32_t kMaxViewHeapSize = 1'000'000;
/// DescriptorRange::OffsetInDescriptorsFromTableStart: right behind the range before.
/// [D3D12: D3D12_DESCRIPTOR_RANGE_OFFSET_APPEND]
inline constexpr uint32_t kDescriptorRangeOffsetAppend = 0xFFFFFFFFu;
/// DescriptorRange::NumDescriptors: as many as the heap holds. [D3D12: D3D12_DESCRIPTOR_RANGE1]
inline constexpr uint32_t kUnboundedDescriptors = 0xFFFFFFFFu;
/// ResourceBarrier::Subresource: all of them. [D3D12: D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES]
inline constexpr uint32_t kResourceBarrierAllSubresources = 0xFFFFFFFFu;
/// ShaderResourceViewDesc::Shader4ComponentMapping: the components as they are.
/// [D3D12: D3D12_DEFAULT_SHADER_4_COMPONENT_MAPPING]
inline constexpr uint32_t kDefaultShader4ComponentMapping = 0x1688;

/// Bytes between two descriptors of a heap, for every heap type.
/// [D3D12: GetDescriptorHandleIncrementSize]
inline constexpr uint32_t kDescriptorHandleIncrementSize = 32;

/// The start of elements in GPU memory, and the distance from one to the next. The members have no
/// default values because unions hold this struct. [DXR: D3D12_GPU_VIRTUAL_ADDRESS_AND_STRIDE]
struct GpuVirtualAddressAndStride {
  GpuVirtualAddress StartAddress;  ///< of the first element
  uint64_t StrideInBytes;          ///< from one element to the next; 0: one element for all indices
};

/// Bytes [StartAddress, StartAddress + SizeInBytes) of GPU memory.
/// [D3D12: D3D12_GPU_VIRTUAL_ADDRESS_RANGE]
struct GpuVirtualAddressRange {
  GpuVirtualAddress StartAddress = 0;  ///< 0: none
  uint64_t SizeInBytes = 0;            ///< from StartAddress on
};

/// A shader table: where it starts, its bytes in all, and the bytes from one record to the next.
/// [D3D12: D3D12_GPU_VIRTUAL_ADDRESS_RANGE_AND_STRIDE]
struct GpuVirtualAddressRangeAndStride {
  GpuVirtualAddress StartAddress = 0;  ///< 0: none
  uint64_t SizeInBytes = 0;            ///< of all records together
  uint64_t StrideInBytes = 0;          ///< 0: every index means the first record
};

/// A slot of a descriptor heap, for the host to write. Valid as long as its heap lives.
/// [D3D12: D3D12_CPU_DESCRIPTOR_HANDLE]
struct CpuDescriptorHandle {
  size_t ptr = 0;  ///< opaque; 0 is no handle
  /// The handle `count` descriptors further on. Nothing checks that it is still in the heap; the
  /// call that takes it does.
  constexpr CpuDescriptorHandle Offset(uint32_t count) const {
    return {ptr + size_t{count} * kDescriptorHandleIncrementSize};
  }
};

/// A slot of a shader-visible heap, as root arguments and shader records hold it. Handles are
/// unique over all heaps of all types, so that one found in a record names its heap and its slot.
/// [DXR: Descriptor handle encodings]
struct GpuDescriptorHandle {
  uint64_t ptr = 0;  ///< opaque; 0 is no handle
  /// The handle `count` descriptors further on. Nothing checks that it is still in the heap; the
  /// call that takes it does.
  constexpr GpuDescriptorHandle Offset(uint32_t count) const {
    return {ptr + uint64_t{count} * kDescriptorHandleIncrementSize};
  }
};

}  // namespace rtapi
