// SPDX-License-Identifier: MIT
//
// Constants, addresses and handles that every other header uses. Names, numbers and layouts are
// those of d3d12.h, which rtapi/src/layout_test.cpp holds them against.
#pragma once

#include <cstddef>
#include <cstdint>

#include <rtapi/flags.h>
#include <rtapi/format.h>

namespace rtapi {

using GpuVirtualAddress = uint64_t;

// [DXR: Constants]
inline constexpr uint32_t kShaderIdentifierSizeInBytes = 32;
inline constexpr uint32_t kRaytracingShaderRecordByteAlignment = 32;
inline constexpr uint32_t kRaytracingShaderTableByteAlignment = 64;
inline constexpr uint32_t kRaytracingMaxShaderRecordStride = 4096;
inline constexpr uint32_t kRaytracingAccelerationStructureByteAlignment = 256;
inline constexpr uint32_t kRaytracingInstanceDescsByteAlignment = 16;
inline constexpr uint32_t kRaytracingTransform3x4ByteAlignment = 16;
inline constexpr uint32_t kRaytracingAabbByteAlignment = 8;
inline constexpr uint32_t kRaytracingMaxAttributeSizeInBytes = 32;
inline constexpr uint32_t kRaytracingMaxDeclarableTraceRecursionDepth = 31;
inline constexpr uint32_t kRaytracingMaxRayGenerationShaderThreads = 1u << 30;
inline constexpr uint32_t kRaytracingMaxGeometriesPerBottomLevelAccelerationStructure = 1u << 24;
inline constexpr uint32_t kRaytracingMaxInstancesPerTopLevelAccelerationStructure = 1u << 24;
inline constexpr uint32_t kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure = 1u << 29;
// 4096 - 32 [DXR: Local root signatures vs global root signatures]
inline constexpr uint32_t kMaxLocalRootArgumentBytes = 4064;

// [D3D12: hardware-independent limits]
inline constexpr uint32_t kMaxRootCost = 64;  // DWORDs of a global root signature
inline constexpr uint32_t kTextureDataPitchAlignment = 256;
inline constexpr uint32_t kTextureDataPlacementAlignment = 512;
inline constexpr uint32_t kConstantBufferDataPlacementAlignment = 256;
inline constexpr uint32_t kRawUavSrvByteAlignment = 16;
inline constexpr uint32_t kReqTexture1DUDimension = 16384;
inline constexpr uint32_t kReqTexture2DUOrVDimension = 16384;
inline constexpr uint32_t kReqTexture3DUVOrWDimension = 2048;
inline constexpr uint32_t kReqTexture2DArrayAxisDimension = 2048;
inline constexpr uint32_t kCsDispatchMaxThreadGroupsPerDimension = 65535;
inline constexpr uint32_t kMaxShaderVisibleSamplerHeapSize = 2048;
inline constexpr uint32_t kDescriptorRangeOffsetAppend = 0xFFFFFFFFu;
inline constexpr uint32_t kUnboundedDescriptors = 0xFFFFFFFFu;
inline constexpr uint32_t kResourceBarrierAllSubresources = 0xFFFFFFFFu;
inline constexpr uint32_t kDefaultShader4ComponentMapping = 0x1688;

// Bytes between two descriptors of a heap, for every heap type.
inline constexpr uint32_t kDescriptorHandleIncrementSize = 32;

struct GpuVirtualAddressAndStride {  // no default values: members of a union hold it
  GpuVirtualAddress StartAddress;
  uint64_t StrideInBytes;
};

struct GpuVirtualAddressRange {
  GpuVirtualAddress StartAddress = 0;
  uint64_t SizeInBytes = 0;
};

struct GpuVirtualAddressRangeAndStride {
  GpuVirtualAddress StartAddress = 0;
  uint64_t SizeInBytes = 0;
  uint64_t StrideInBytes = 0;
};

// A slot of a descriptor heap as the host writes it. 0 is no handle.
struct CpuDescriptorHandle {
  size_t ptr = 0;
  // The handle `count` descriptors further on.
  constexpr CpuDescriptorHandle Offset(uint32_t count) const {
    return {ptr + size_t{count} * kDescriptorHandleIncrementSize};
  }
};

// A slot of a shader-visible heap as root arguments and shader records name it. Unique over all
// heaps of all types. [DXR: Descriptor handle encodings]
struct GpuDescriptorHandle {
  uint64_t ptr = 0;
  constexpr GpuDescriptorHandle Offset(uint32_t count) const {
    return {ptr + uint64_t{count} * kDescriptorHandleIncrementSize};
  }
};

}  // namespace rtapi
