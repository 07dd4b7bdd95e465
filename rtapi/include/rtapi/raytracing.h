// SPDX-License-Identifier: MIT
//
// Acceleration structures and dispatch descriptions, byte for byte as in d3d12.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include <rtapi/types.h>

namespace rtapi {

enum class RaytracingTier : uint32_t { kNotSupported = 0, kTier1_0 = 10, kTier1_1 = 11 };

// [DXR: Ray flags]
enum class RayFlags : uint32_t {
  kNone = 0,
  kForceOpaque = 0x1,
  kForceNonOpaque = 0x2,
  kAcceptFirstHitAndEndSearch = 0x4,
  kSkipClosestHitShader = 0x8,
  kCullBackFacingTriangles = 0x10,
  kCullFrontFacingTriangles = 0x20,
  kCullOpaque = 0x40,
  kCullNonOpaque = 0x80,
  kSkipTriangles = 0x100,
  kSkipProceduralPrimitives = 0x200,
};
template <>
inline constexpr bool kIsFlags<RayFlags> = true;

inline constexpr uint32_t kHitKindTriangleFrontFace = 254;
inline constexpr uint32_t kHitKindTriangleBackFace = 255;

enum class RaytracingGeometryType : uint32_t { kTriangles = 0, kProceduralPrimitiveAabbs = 1 };

enum class RaytracingGeometryFlags : uint32_t {
  kNone = 0,
  kOpaque = 0x1,
  kNoDuplicateAnyHitInvocation = 0x2,
};
template <>
inline constexpr bool kIsFlags<RaytracingGeometryFlags> = true;

enum class RaytracingInstanceFlags : uint32_t {
  kNone = 0,
  kTriangleCullDisable = 0x1,
  kTriangleFrontCounterclockwise = 0x2,
  kForceOpaque = 0x4,
  kForceNonOpaque = 0x8,
};
template <>
inline constexpr bool kIsFlags<RaytracingInstanceFlags> = true;

// The two geometry kinds have no default member values: a union holds them. Name VertexFormat.
struct RaytracingGeometryTrianglesDesc {
  GpuVirtualAddress Transform3x4;  // 12 floats, row-major, 16-byte aligned; 0: none
  Format IndexFormat;              // kR16Uint, kR32Uint; kUnknown: not indexed
  Format VertexFormat;             // [DXR: D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC]
  uint32_t IndexCount;
  uint32_t VertexCount;
  GpuVirtualAddress IndexBuffer;  // 0 exactly when IndexFormat is kUnknown
  GpuVirtualAddressAndStride VertexBuffer;
};

struct RaytracingAabb {
  float MinX = 0;  // NaN: inactive
  float MinY = 0;
  float MinZ = 0;
  float MaxX = 0;
  float MaxY = 0;
  float MaxZ = 0;
};

struct RaytracingGeometryAabbsDesc {
  uint64_t AABBCount;
  GpuVirtualAddressAndStride AABBs;  // multiples of 8; stride 0: the same box for all
};

struct RaytracingGeometryDesc {
  RaytracingGeometryType Type = RaytracingGeometryType::kTriangles;
  RaytracingGeometryFlags Flags = RaytracingGeometryFlags::kNone;
  union {
    RaytracingGeometryTrianglesDesc Triangles = {};
    RaytracingGeometryAabbsDesc AABBs;
  };
};

// In GPU memory, 16-byte aligned. [DXR: D3D12_RAYTRACING_INSTANCE_DESC]
struct RaytracingInstanceDesc {
  float Transform[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};  // instance to world
  uint32_t InstanceID : 24 = 0;
  uint32_t InstanceMask : 8 = 0xFF;
  uint32_t InstanceContributionToHitGroupIndex : 24 = 0;
  uint32_t Flags : 8 = 0;                       // RaytracingInstanceFlags
  GpuVirtualAddress AccelerationStructure = 0;  // bottom level; 0: inactive
};

enum class RaytracingAccelerationStructureType : uint32_t { kTopLevel = 0, kBottomLevel = 1 };

enum class RaytracingAccelerationStructureBuildFlags : uint32_t {
  kNone = 0,
  kAllowUpdate = 0x1,
  kAllowCompaction = 0x2,
  kPreferFastTrace = 0x4,
  kPreferFastBuild = 0x8,
  kMinimizeMemory = 0x10,
  kPerformUpdate = 0x20,
};
template <>
inline constexpr bool kIsFlags<RaytracingAccelerationStructureBuildFlags> = true;

enum class ElementsLayout : uint32_t { kArray = 0, kArrayOfPointers = 1 };

struct BuildRaytracingAccelerationStructureInputs {
  RaytracingAccelerationStructureType Type = RaytracingAccelerationStructureType::kTopLevel;
  RaytracingAccelerationStructureBuildFlags Flags =
      RaytracingAccelerationStructureBuildFlags::kNone;
  uint32_t NumDescs = 0;
  ElementsLayout DescsLayout = ElementsLayout::kArray;
  union {
    // Top level. kArray: NumDescs instance descs; kArrayOfPointers: NumDescs addresses of them,
    // 8-byte aligned.
    GpuVirtualAddress InstanceDescs = 0;
    const RaytracingGeometryDesc* pGeometryDescs;          // bottom level, kArray
    const RaytracingGeometryDesc* const* ppGeometryDescs;  // bottom level, kArrayOfPointers
  };
};

struct BuildRaytracingAccelerationStructureDesc {
  GpuVirtualAddress DestAccelerationStructureData = 0;  // 256-byte aligned, like the other two
  BuildRaytracingAccelerationStructureInputs Inputs = {};
  GpuVirtualAddress SourceAccelerationStructureData = 0;  // kPerformUpdate only
  GpuVirtualAddress ScratchAccelerationStructureData = 0;
};

struct RaytracingAccelerationStructurePrebuildInfo {
  uint64_t ResultDataMaxSizeInBytes = 0;
  uint64_t ScratchDataSizeInBytes = 0;
  uint64_t UpdateScratchDataSizeInBytes = 0;
};

enum class RaytracingAccelerationStructurePostbuildInfoType : uint32_t {
  kCompactedSize = 0,       // 8 bytes
  kToolsVisualization = 1,  // 8 bytes
  kSerialization = 2,       // 16 bytes
  kCurrentSize = 3,         // 8 bytes
};

struct RaytracingAccelerationStructurePostbuildInfoDesc {
  GpuVirtualAddress DestBuffer = 0;  // 8-byte aligned
  RaytracingAccelerationStructurePostbuildInfoType InfoType =
      RaytracingAccelerationStructurePostbuildInfoType::kCompactedSize;
};

struct RaytracingAccelerationStructurePostbuildInfoCompactedSizeDesc {
  uint64_t CompactedSizeInBytes = 0;
};
struct RaytracingAccelerationStructurePostbuildInfoToolsVisualizationDesc {
  uint64_t DecodedSizeInBytes = 0;
};
struct RaytracingAccelerationStructurePostbuildInfoSerializationDesc {
  uint64_t SerializedSizeInBytes = 0;
  uint64_t NumBottomLevelAccelerationStructurePointers = 0;
};
struct RaytracingAccelerationStructurePostbuildInfoCurrentSizeDesc {
  uint64_t CurrentSizeInBytes = 0;
};

enum class RaytracingAccelerationStructureCopyMode : uint32_t {
  kClone = 0,
  kCompact = 1,
  kVisualizationDecodeForTools = 2,
  kSerialize = 3,
  kDeserialize = 4,
};

enum class SerializedDataType : uint32_t { kRaytracingAccelerationStructure = 0 };

// What Device::CheckDriverMatchingIdentifier says of serialized data.
enum class DriverMatchingIdentifierStatus : uint32_t {
  kCompatibleWithDevice = 0,
  kUnsupportedType = 1,
  kUnrecognized = 2,         // another driver's
  kIncompatibleVersion = 3,  // of another version of this library
  kIncompatibleType = 4,
};

struct Guid {
  uint32_t Data1 = 0;
  uint16_t Data2 = 0;
  uint16_t Data3 = 0;
  uint8_t Data4[8] = {};

  bool operator==(const Guid&) const = default;
};

// Opaque. Every backend writes the same one: what one wrote the others read.
struct SerializedDataDriverMatchingIdentifier {
  Guid DriverOpaqueGUID = {};
  uint8_t DriverOpaqueVersioningData[16] = {};
};

// What kSerialize writes begins with it; then come as many 8-byte addresses of bottom levels, which
// the application replaces by those of their copies before kDeserialize.
// [DXR: D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER]
struct SerializedRaytracingAccelerationStructureHeader {
  SerializedDataDriverMatchingIdentifier DriverMatchingIdentifier = {};
  uint64_t SerializedSizeInBytesIncludingHeader = 0;
  uint64_t DeserializedSizeInBytes = 0;
  uint64_t NumBottomLevelAccelerationStructurePointersAfterHeader = 0;
};

// What kVisualizationDecodeForTools writes begins with it; then come NumDescs instance or geometry
// descs without a gap, then what their addresses name.
struct BuildRaytracingAccelerationStructureToolsVisualizationHeader {
  RaytracingAccelerationStructureType Type = RaytracingAccelerationStructureType::kTopLevel;
  uint32_t NumDescs = 0;
};

// [DXR: D3D12_DISPATCH_RAYS_DESC]. Starts are multiples of 64, strides of 32 up to 4096.
struct DispatchRaysDesc {
  GpuVirtualAddressRange RayGenerationShaderRecord = {};
  GpuVirtualAddressRangeAndStride MissShaderTable = {};
  GpuVirtualAddressRangeAndStride HitGroupTable = {};
  GpuVirtualAddressRangeAndStride CallableShaderTable = {};
  uint32_t Width = 1;
  uint32_t Height = 1;
  uint32_t Depth = 1;
};

static_assert(sizeof(RaytracingInstanceDesc) == 64 && sizeof(RaytracingGeometryDesc) == 56 &&
              sizeof(DispatchRaysDesc) == 104 &&
              sizeof(SerializedRaytracingAccelerationStructureHeader) == 56);

}  // namespace rtapi
