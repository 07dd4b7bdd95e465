// SPDX-License-Identifier: MIT
/// @file
/// Acceleration structures and dispatch descriptions, byte for byte as in d3d12.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include <rtapi/types.h>

namespace rtapi {

/// HLSL's RAY_FLAG values, for code that shares them with shaders. At most one of kForceOpaque,
/// kForceNonOpaque, kCullOpaque and kCullNonOpaque; at most one of the two facing culls and
/// kSkipTriangles; not both skips. The skips need tier 1.1 (KA0542). Checked mode reports illegal
/// flags (KA0403, KA0404). [DXR: Ray flags]
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
  kForceOmm2State = 0x400,  ///< unknown states of opacity micromaps become known ones; tier 1.2
};
template <>
inline constexpr bool kIsFlags<RayFlags> = true;

/// HitKind() of a triangle met at its front face. [DXR: HitKind]
inline constexpr uint32_t kHitKindTriangleFrontFace = 254;
/// HitKind() of a triangle met at its back face. [DXR: HitKind]
inline constexpr uint32_t kHitKindTriangleBackFace = 255;

/// The kind of primitives of a geometry. The geometries of a bottom level are all triangles, with
/// or without micromaps, or all AABBs (KA0702). [DXR: D3D12_RAYTRACING_GEOMETRY_TYPE]
enum class RaytracingGeometryType : uint32_t {
  kTriangles = 0,
  kProceduralPrimitiveAabbs = 1,
  kOmmTriangles = 2,  ///< triangles with opacity micromaps; needs tier 1.2 (KA0546)
};

/// Flags that control what any-hit shaders see of a geometry's primitives.
/// [DXR: D3D12_RAYTRACING_GEOMETRY_FLAGS]
enum class RaytracingGeometryFlags : uint32_t {
  kNone = 0,
  kOpaque = 0x1,                       ///< no any-hit shader runs, unless instance or ray say so
  kNoDuplicateAnyHitInvocation = 0x2,  ///< at most one any-hit shader per intersection and ray
};
template <>
inline constexpr bool kIsFlags<RaytracingGeometryFlags> = true;

/// Culling, facing and opacity of an instance: RaytracingInstanceDesc::Flags.
/// [DXR: D3D12_RAYTRACING_INSTANCE_FLAGS]
enum class RaytracingInstanceFlags : uint32_t {
  kNone = 0,
  kTriangleCullDisable = 0x1,            ///< facing culls of the ray have no effect
  kTriangleFrontCounterclockwise = 0x2,  ///< else fronts are clockwise, seen from the ray's origin
  kForceOpaque = 0x4,                    ///< replaces the geometries' opacity; not with the next
  kForceNonOpaque = 0x8,                 ///< replaces the geometries' opacity; KA0474 with both
  kForceOmm2State = 0x10,  ///< unknown states of opacity micromaps become known ones; tier 1.2
  kDisableOmms = 0x20,     ///< as if not linked; needs kAllowDisableOmms of the bottom level
};
template <>
inline constexpr bool kIsFlags<RaytracingInstanceFlags> = true;

/// A triangle list, indexed or not. A build reads its memory when the command executes, and keeps
/// nothing of it. Every three indices (or vertices) are a triangle; a rest of one or two is
/// ignored. A triangle with NaN as the x of any vertex is inactive: it is never hit, but counts in
/// PrimitiveIndex. The members have no default values because a union holds this struct; set
/// VertexFormat in any case. [DXR: D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC]
struct RaytracingGeometryTrianglesDesc {
  /// 3 x 4 floats, row-major, applied to the vertices by the build: a multiple of 16 (KA0707).
  /// 0: none.
  GpuVirtualAddress Transform3x4;
  Format IndexFormat;  ///< kR16Uint or kR32Uint; kUnknown: not indexed (KA0704)
  /// kR32G32(B32)Float, kR16G16(B16A16)Float or Snorm; with tier 1.1 also kR16G16(B16A16)Unorm,
  /// kR10G10B10A2Unorm, kR8G8(B8A8)Unorm or Snorm (KA0703). Two components: z is 0. A is ignored.
  Format VertexFormat;
  uint32_t IndexCount;  ///< 0 if IndexFormat is kUnknown
  /// Vertices of the buffer. With indices, more than the largest of them: triangles with a larger
  /// index are never hit, which is a warning (KA0798).
  uint32_t VertexCount;
  /// A multiple of the index size; 0 exactly when IndexFormat is kUnknown (KA0704).
  GpuVirtualAddress IndexBuffer;
  /// Address and stride are multiples of the size of a component: 4, 2 or 1 bytes; of
  /// kR10G10B10A2Unorm the stride is 4 (KA0705). Only the low 32 bits of the stride count.
  GpuVirtualAddressAndStride VertexBuffer;
};

/// A box of procedural geometry as it lies in GPU memory, 24 bytes, in object space. NaN as MinX
/// makes it inactive; Min larger than Max makes it a point. [DXR: D3D12_RAYTRACING_AABB]
struct RaytracingAabb {
  /// A face of the box.
  ///@{
  float MinX = 0;
  float MinY = 0;
  float MinZ = 0;
  float MaxX = 0;
  float MaxY = 0;
  float MaxZ = 0;
  ///@}
};

/// Boxes in GPU memory, each a RaytracingAabb; read when the build executes.
/// [DXR: D3D12_RAYTRACING_GEOMETRY_AABBS_DESC]
struct RaytracingGeometryAabbsDesc {
  uint64_t AABBCount;                ///< boxes; at most 2^29 in a bottom level (KA0709)
  GpuVirtualAddressAndStride AABBs;  ///< multiples of 8 (KA0708); stride 0: one box for all
};

/// The kind of values that an opacity micromap holds.
/// [DXR: D3D12_RAYTRACING_OPACITY_MICROMAP_FORMAT]
enum class RaytracingOpacityMicromapFormat : uint32_t {
  kOc1_2State = 1,  ///< a bit for each micro-triangle, the lowest first
  kOc1_4State = 2,  ///< two bits for each micro-triangle, the lowest first
};

/// What a micro-triangle is. Any-hit shaders decide about unknown ones only; where two states are
/// forced, these become transparent or opaque. [DXR: D3D12_RAYTRACING_OPACITY_MICROMAP_STATE]
enum class RaytracingOpacityMicromapState : uint32_t {
  kTransparent = 0,
  kOpaque = 1,
  kUnknownTransparent = 2,
  kUnknownOpaque = 3,
};

/// Indices that stand for a triangle of one state, instead of a micromap of the array. 8- and
/// 16-bit indices have their low bits. [DXR: D3D12_RAYTRACING_OPACITY_MICROMAP_SPECIAL_INDEX]
enum class RaytracingOpacityMicromapSpecialIndex : int32_t {
  kFullyTransparent = -1,
  kFullyOpaque = -2,
  kFullyUnknownTransparent = -3,
  kFullyUnknownOpaque = -4,
  kClusterSkipOmm = -5,  ///< the geometry's own opacity; for clusters
};

/// How many micromaps of a level and a format an array has.
/// [DXR: D3D12_RAYTRACING_OPACITY_MICROMAP_HISTOGRAM_ENTRY]
struct RaytracingOpacityMicromapHistogramEntry {
  uint32_t Count = 0;             ///< how many there are
  uint32_t SubdivisionLevel = 0;  ///< 0 to 12: 4^level micro-triangles
  /// The format of them all.
  RaytracingOpacityMicromapFormat Format = RaytracingOpacityMicromapFormat::kOc1_2State;
};

/// One micromap of an array, as it lies in GPU memory.
/// [DXR: D3D12_RAYTRACING_OPACITY_MICROMAP_DESC]
struct RaytracingOpacityMicromapDesc {
  uint32_t ByteOffset = 0;        ///< of its states in InputBuffer; any number
  uint16_t SubdivisionLevel = 0;  ///< 0 to 12
  uint16_t Format = 0;            ///< RaytracingOpacityMicromapFormat
};

/// The inputs of an opacity micromap array, in host memory; copied when the call is made. What the
/// two addresses name is read when the build executes. Invalid: KA0746.
/// [DXR: D3D12_RAYTRACING_OPACITY_MICROMAP_ARRAY_DESC]
struct RaytracingOpacityMicromapArrayDesc {
  uint32_t NumOmmHistogramEntries = 0;  ///< of the histogram
  /// The counts add up to the number of micromaps.
  const RaytracingOpacityMicromapHistogramEntry* pOmmHistogram = nullptr;
  GpuVirtualAddress InputBuffer = 0;  ///< the states of all micromaps: a multiple of 128
  /// A RaytracingOpacityMicromapDesc for each micromap; multiples of 4, stride 0: one for all.
  GpuVirtualAddressAndStride PerOmmDescs = {};
};

/// Which micromap each triangle of a geometry has. Invalid: KA0747.
/// [DXR: D3D12_RAYTRACING_GEOMETRY_OMM_LINKAGE_DESC]
struct RaytracingGeometryOmmLinkageDesc {
  /// An index for each triangle, read when the build executes: a special one, or one that is added
  /// to the base. Address and stride are multiples of its size.
  GpuVirtualAddressAndStride OpacityMicromapIndexBuffer = {};
  /// kR8Uint, kR16Uint or kR32Uint; kUnknown: no buffer, triangle k has micromap base + k.
  Format OpacityMicromapIndexFormat = Format::kUnknown;
  uint32_t OpacityMicromapBaseLocation = 0;  ///< the base
  /// The address of an array, which rays read; 0 if all indices are special ones.
  GpuVirtualAddress OpacityMicromapArray = 0;
};

/// Triangles with opacity micromaps, in host memory; copied when the call is made.
/// [DXR: D3D12_RAYTRACING_GEOMETRY_OMM_TRIANGLES_DESC]
struct RaytracingGeometryOmmTrianglesDesc {
  const RaytracingGeometryTrianglesDesc* pTriangles;    ///< not null (KA0747)
  const RaytracingGeometryOmmLinkageDesc* pOmmLinkage;  ///< not null (KA0747)
};

/// One geometry of a bottom level, in host memory. Its index in the inputs is GeometryIndex.
/// [DXR: D3D12_RAYTRACING_GEOMETRY_DESC]
struct RaytracingGeometryDesc {
  RaytracingGeometryType Type = RaytracingGeometryType::kTriangles;  ///< which member counts
  RaytracingGeometryFlags Flags = RaytracingGeometryFlags::kNone;    ///< for every primitive of it
  union {
    RaytracingGeometryTrianglesDesc Triangles = {};   ///< kTriangles
    RaytracingGeometryAabbsDesc AABBs;                ///< kProceduralPrimitiveAabbs
    RaytracingGeometryOmmTrianglesDesc OmmTriangles;  ///< kOmmTriangles
  };
};

/// One instance of a top level, as it lies in GPU memory: 64 bytes, at a multiple of 16. Its index
/// in the inputs is InstanceIndex. [DXR: D3D12_RAYTRACING_INSTANCE_DESC]
struct RaytracingInstanceDesc {
  /// From object to world space, 3 x 4 floats, row-major.
  float Transform[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  uint32_t InstanceID : 24 = 0;  ///< what shaders read as InstanceID()
  /// A ray meets the instance if this and its InstanceInclusionMask share a bit; 0: no ray does.
  uint32_t InstanceMask : 8 = 0xFF;
  /// Added to the index of the hit record. [DXR: Hit group table indexing]
  uint32_t InstanceContributionToHitGroupIndex : 24 = 0;
  uint32_t Flags : 8 = 0;  ///< RaytracingInstanceFlags
  /// The address of a bottom level, which must be there when the top level is traced; 0: inactive,
  /// never hit. Anything else than a bottom level makes it inactive with a warning (KA0797).
  GpuVirtualAddress AccelerationStructure = 0;
};

/// The kind of an acceleration structure. [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE]
enum class RaytracingAccelerationStructureType : uint32_t {
  kTopLevel = 0,
  kBottomLevel = 1,
  kOpacityMicromapArray = 2,  ///< what bottom levels are linked to; needs tier 1.2 (KA0546)
  /// EXPERIMENTAL, of BuildRaytracingAccelerationStructureToolsVisualizationHeader only (KA0700):
  /// what ExecuteIndirectRTASOperations makes.
  ///@{
  kClusterLevel = 3,
  kClusterTemplate = 4,
  kClusteredBottomLevel = 5,
  kPartitionedTopLevel = 6,
  ///@}
};

/// Flags that say how a structure is built and what may be done with it later. kPreferFastTrace and
/// kPreferFastBuild exclude each other (KA0701); micromap arrays take these two and
/// kAllowCompaction only (KA0746).
/// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAGS]
enum class RaytracingAccelerationStructureBuildFlags : uint32_t {
  kNone = 0,
  kAllowUpdate = 0x1,      ///< may be the source of an update
  kAllowCompaction = 0x2,  ///< may be copied by kCompact
  kPreferFastTrace = 0x4,  ///< a better tree, slower to build
  kPreferFastBuild = 0x8,  ///< a worse tree, faster to build
  kMinimizeMemory = 0x10,  ///< a smaller tree
  kPerformUpdate = 0x20,   ///< refit SourceAccelerationStructureData instead of building anew
  kAllowOmmLinkageUpdate = 0x40,  ///< updates may change linkages; with kAllowUpdate (KA0747)
  kAllowOmmUpdate = 0x40,         ///< the same, as d3d12.h calls it
  kAllowDisableOmms = 0x80,       ///< instances may have kDisableOmms
  /// EXPERIMENTAL, shader model 6.10: shaders may read the vertices of its triangles, by
  /// TriangleObjectPositions. For bottom levels (KA0548).
  kAllowDataAccess = 0x100,
};
template <>
inline constexpr bool kIsFlags<RaytracingAccelerationStructureBuildFlags> = true;

/// Tells whether inputs lie in one array or each on its own. [DXR: D3D12_ELEMENTS_LAYOUT]
enum class ElementsLayout : uint32_t { kArray = 0, kArrayOfPointers = 1 };

/// The inputs of a build, for builds and for prebuild info.
/// [DXR: D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS]
struct BuildRaytracingAccelerationStructureInputs {
  /// The level to build.
  RaytracingAccelerationStructureType Type = RaytracingAccelerationStructureType::kTopLevel;
  /// In an update all but kAllowUpdate and kPerformUpdate equal those of the source.
  RaytracingAccelerationStructureBuildFlags Flags =
      RaytracingAccelerationStructureBuildFlags::kNone;
  /// Instances or geometries: up to 2^24; 0 is legal. 1 for a micromap array.
  uint32_t NumDescs = 0;
  ElementsLayout DescsLayout = ElementsLayout::kArray;  ///< of the member of the union
  union {
    /// Top level, GPU memory that is read when the build executes. kArray: NumDescs instance descs,
    /// at a multiple of 16; kArrayOfPointers: NumDescs addresses of such descs, at a multiple of 8.
    GpuVirtualAddress InstanceDescs = 0;
    /// Bottom level, kArray: NumDescs descs in host memory, copied when the call is made.
    const RaytracingGeometryDesc* pGeometryDescs;
    /// Bottom level, kArrayOfPointers: NumDescs pointers in host memory, none of them null; the
    /// descs are copied when the call is made.
    const RaytracingGeometryDesc* const* ppGeometryDescs;
    /// Micromap array, kArray: in host memory, copied when the call is made.
    const RaytracingOpacityMicromapArrayDesc* pOpacityMicromapArrayDesc;
  };
};

/// A build for CommandList::BuildRaytracingAccelerationStructure. The three addresses are multiples
/// of 256. [DXR: D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC]
struct BuildRaytracingAccelerationStructureDesc {
  /// The place where the structure goes: ResultDataMaxSizeInBytes in a buffer that was created in
  /// state kRaytracingAccelerationStructure; of an update as many bytes as the source has.
  GpuVirtualAddress DestAccelerationStructureData = 0;
  BuildRaytracingAccelerationStructureInputs Inputs = {};  ///< what is built
  /// With kPerformUpdate: what is refitted, the destination itself or one that does not overlap it.
  /// Otherwise 0.
  GpuVirtualAddress SourceAccelerationStructureData = 0;
  /// ScratchDataSizeInBytes (of an update UpdateScratchDataSizeInBytes) in a buffer that allows
  /// unordered access. Its contents do not count before, and are undefined afterwards.
  GpuVirtualAddress ScratchAccelerationStructureData = 0;
};

/// Bytes that a build needs, see Device::GetRaytracingAccelerationStructurePrebuildInfo.
/// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO]
struct RaytracingAccelerationStructurePrebuildInfo {
  uint64_t ResultDataMaxSizeInBytes = 0;      ///< of the structure, before it is compacted
  uint64_t ScratchDataSizeInBytes = 0;        ///< of scratch memory for the build
  uint64_t UpdateScratchDataSizeInBytes = 0;  ///< for any later update; 0 without kAllowUpdate
};

/// The numbers of a built structure that are written to memory.
/// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_TYPE]
enum class RaytracingAccelerationStructurePostbuildInfoType : uint32_t {
  kCompactedSize = 0,       ///< RaytracingAccelerationStructurePostbuildInfoCompactedSizeDesc
  kToolsVisualization = 1,  ///< RaytracingAccelerationStructurePostbuildInfoToolsVisualizationDesc
  kSerialization = 2,       ///< RaytracingAccelerationStructurePostbuildInfoSerializationDesc
  kCurrentSize = 3,         ///< RaytracingAccelerationStructurePostbuildInfoCurrentSizeDesc
};

/// A request for postbuild info, written when the command executes.
/// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC]
struct RaytracingAccelerationStructurePostbuildInfoDesc {
  /// A multiple of 8 in a buffer that allows unordered access.
  GpuVirtualAddress DestBuffer = 0;
  /// The numbers that are written: 8 bytes for each source, kSerialization 16.
  RaytracingAccelerationStructurePostbuildInfoType InfoType =
      RaytracingAccelerationStructurePostbuildInfoType::kCompactedSize;
};

/// The 8 bytes that kCompactedSize writes.
/// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_COMPACTED_SIZE_DESC]
struct RaytracingAccelerationStructurePostbuildInfoCompactedSizeDesc {
  uint64_t CompactedSizeInBytes = 0;  ///< what a copy by kCompact takes
};
/// The 8 bytes that kToolsVisualization writes.
/// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_TOOLS_VISUALIZATION_DESC]
struct RaytracingAccelerationStructurePostbuildInfoToolsVisualizationDesc {
  uint64_t DecodedSizeInBytes = 0;  ///< what kVisualizationDecodeForTools writes
};
/// The 16 bytes that kSerialization writes.
/// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_SERIALIZATION_DESC]
struct RaytracingAccelerationStructurePostbuildInfoSerializationDesc {
  uint64_t SerializedSizeInBytes = 0;  ///< what kSerialize writes, header and pointers included
  /// One for each instance, also where several name one bottom level or one names none; of a bottom
  /// level 0, or 1 if it is linked to micromap arrays: the number of blocks. Of an array 0.
  /// EXPERIMENTAL: of clusters and templates as of bottom levels; of a bottom level of clusters and
  /// of a partitioned top level 1.
  uint64_t NumBottomLevelAccelerationStructurePointers = 0;
};
/// The 8 bytes that kCurrentSize writes.
/// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_CURRENT_SIZE_DESC]
struct RaytracingAccelerationStructurePostbuildInfoCurrentSizeDesc {
  uint64_t CurrentSizeInBytes = 0;  ///< the prebuild size, or that of the compacted copy
};

/// The kind of copy that CommandList::CopyRaytracingAccelerationStructure makes.
/// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE]
enum class RaytracingAccelerationStructureCopyMode : uint32_t {
  kClone = 0,                        ///< the same structure, as many bytes
  kCompact = 1,                      ///< the same in fewer bytes; needs kAllowCompaction
  kVisualizationDecodeForTools = 2,  ///< header and inputs, as a build would take them
  kSerialize = 3,                    ///< bytes for a file
  kDeserialize = 4,                  ///< a structure of such bytes
};

/// The type of data that Device::CheckDriverMatchingIdentifier is asked about.
/// [DXR: D3D12_SERIALIZED_DATA_TYPE]
enum class SerializedDataType : uint32_t { kRaytracingAccelerationStructure = 0 };

/// The verdict of Device::CheckDriverMatchingIdentifier on serialized data.
/// [DXR: D3D12_DRIVER_MATCHING_IDENTIFIER_STATUS]
enum class DriverMatchingIdentifierStatus : uint32_t {
  kCompatibleWithDevice = 0,  ///< the device can read it
  kUnsupportedType = 1,       ///< no acceleration structure
  kUnrecognized = 2,          ///< another driver wrote it
  kIncompatibleVersion = 3,   ///< another version of this library wrote it
  kIncompatibleType = 4,      ///< never returned
};

/// A GUID, laid out as on Windows.
struct Guid {
  /// The parts of the GUID as it is written, Data4 byte by byte.
  ///@{
  uint32_t Data1 = 0;
  uint16_t Data2 = 0;
  uint16_t Data3 = 0;
  uint8_t Data4[8] = {};
  ///@}

  /// True if all bits are equal.
  bool operator==(const Guid&) const = default;
};

/// By what a device recognizes serialized data. Opaque. Every backend writes the same one: what one
/// wrote the others read. [DXR: D3D12_SERIALIZED_DATA_DRIVER_MATCHING_IDENTIFIER]
struct SerializedDataDriverMatchingIdentifier {
  Guid DriverOpaqueGUID = {};                   ///< of this library
  uint8_t DriverOpaqueVersioningData[16] = {};  ///< of the form of the data
};

/// The header of what kSerialize writes. It is followed by the 8-byte addresses of the bottom
/// levels, one for each instance in their order, which the application replaces by those of their
/// copies before kDeserialize, and opaque data. The address of an instance without a bottom level
/// is 0. [DXR: D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER]
struct SerializedRaytracingAccelerationStructureHeader {
  SerializedDataDriverMatchingIdentifier DriverMatchingIdentifier = {};  ///< who can read it
  uint64_t SerializedSizeInBytesIncludingHeader = 0;  ///< header, addresses and data
  uint64_t DeserializedSizeInBytes = 0;               ///< what kDeserialize takes
  uint64_t NumBottomLevelAccelerationStructurePointersAfterHeader = 0;  ///< bottom levels: 0
};

/// What follows the header of a serialized structure.
/// [DXR: D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER_POSTAMBLE_TYPE]
enum class SerializedHeaderPostambleType : uint32_t {
  kNone = 0,                 ///< nothing
  kBottomLevelPointers = 0,  ///< addresses of bottom levels
  kBlocks = 0xFFFFFFFF,      ///< SerializedRaytracingAccelerationStructureBlock
};

/// The same header as newer structures have it: a bottom level that is linked to micromap arrays
/// has one block, with the addresses of the arrays. They are replaced by those of the copies before
/// kDeserialize; those that are 0 stay so. EXPERIMENTAL: so does a cluster or template; a bottom
/// level of clusters has a block with the addresses of its clusters, and a partitioned top level
/// one with those of its instances' bottom levels.
/// [DXR: D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER1]
struct SerializedRaytracingAccelerationStructureHeader1 {
  SerializedDataDriverMatchingIdentifier DriverMatchingIdentifier = {};  ///< who can read it
  uint64_t SerializedSizeInBytesIncludingHeader = 0;  ///< header, blocks and data
  uint64_t DeserializedSizeInBytes = 0;               ///< what kDeserialize takes
  uint32_t NumBlocks = 0;                             ///< or bottom levels, by the next member
  /// What follows the header.
  SerializedHeaderPostambleType HeaderPostambleType = SerializedHeaderPostambleType::kNone;
};

/// The kind of structures whose addresses a block lists.
/// [DXR: D3D12_SERIALIZED_BLOCK_TYPE]
enum class SerializedBlockType : uint32_t {
  kOpacityMicromaps = 0,  ///< micromap arrays
  kBottomLevel = 1,       ///< EXPERIMENTAL: of instances of a partitioned top level
  kClusterLevel = 2,      ///< EXPERIMENTAL: clusters
};

/// A block after the header, followed by 8-byte addresses.
/// [DXR: D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_BLOCK]
struct SerializedRaytracingAccelerationStructureBlock {
  SerializedBlockType Type = SerializedBlockType::kOpacityMicromaps;  ///< what they are of
  uint64_t NumBlockPointersAfterHeader = 0;                           ///< how many addresses follow
};

/// The header of what kVisualizationDecodeForTools writes. It is followed by NumDescs instance or
/// geometry descs without a gap, in the order of the inputs, and what their addresses name.
/// EXPERIMENTAL: or, without a gap, by the argument that makes the same: one
/// RtasBuildClasFromTrianglesArgs (vertices kFloat32x3, indices kUint8, micromap indices kUint32),
/// RtasBuildClusterTemplatesFromTrianglesArgs (likewise; indices kUint32) or
/// RtasBuildBlasFromClasArgs, or NumDescs RtasPartitionedTlasOperation.
/// [DXR: D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_TOOLS_VISUALIZATION_HEADER]
struct BuildRaytracingAccelerationStructureToolsVisualizationHeader {
  /// Tells which kind of descs follow.
  RaytracingAccelerationStructureType Type = RaytracingAccelerationStructureType::kTopLevel;
  uint32_t NumDescs = 0;  ///< how many of them
};

/// The shader tables and the grid of a dispatch, for CommandList::DispatchRays and, in GPU memory,
/// for ExecuteIndirect; 104 bytes. Tables start at multiples of 64 and have strides of a multiple
/// of 32, up to 4096 (KA0813); each lies in one live buffer (KA0815). A table that no ray reaches
/// may be a zero range. [DXR: D3D12_DISPATCH_RAYS_DESC]
struct DispatchRaysDesc {
  /// One record: 32 bytes or more.
  GpuVirtualAddressRange RayGenerationShaderRecord = {};
  /// Indexed by MissShaderIndex of TraceRay. [DXR: Miss shader table indexing]
  GpuVirtualAddressRangeAndStride MissShaderTable = {};
  /// Indexed by ray, geometry and instance. [DXR: Hit group table indexing]
  GpuVirtualAddressRangeAndStride HitGroupTable = {};
  /// Indexed by ShaderIndex of CallShader. [DXR: Callable shader table indexing]
  GpuVirtualAddressRangeAndStride CallableShaderTable = {};
  /// Threads along an axis; 2^30 in all (KA0814). Nothing runs where one of the three is 0.
  ///@{
  uint32_t Width = 1;
  uint32_t Height = 1;
  uint32_t Depth = 1;
  ///@}
};

static_assert(sizeof(RaytracingInstanceDesc) == 64 && sizeof(RaytracingGeometryDesc) == 56 &&
              sizeof(DispatchRaysDesc) == 104 &&
              sizeof(SerializedRaytracingAccelerationStructureHeader) == 56 &&
              sizeof(SerializedRaytracingAccelerationStructureHeader1) == 56 &&
              sizeof(SerializedRaytracingAccelerationStructureBlock) == 16);
static_assert(sizeof(RaytracingOpacityMicromapHistogramEntry) == 12 &&
              sizeof(RaytracingOpacityMicromapDesc) == 8 &&
              sizeof(RaytracingOpacityMicromapArrayDesc) == 40 &&
              sizeof(RaytracingGeometryOmmLinkageDesc) == 32 &&
              sizeof(RaytracingGeometryOmmTrianglesDesc) == 16);

}  // namespace rtapi
