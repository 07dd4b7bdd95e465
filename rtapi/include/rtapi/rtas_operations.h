// SPDX-License-Identifier: MIT
/// @file
/// EXPERIMENTAL: acceleration structure operations whose arguments lie in GPU memory: partitioned
/// top levels, clusters and bottom levels of clusters. Names, numbers and layouts are those of the
/// specification of DXR 2.0, version 0.28, which still moves; all that depends on it is here. A
/// device has them where DeviceDesc::IndirectRtasOperations asks for it. [DXR 2.0:
/// ExecuteIndirectRTASOperations]
#pragma once

#include <cstddef>
#include <cstdint>

#include <rtapi/raytracing.h>
#include <rtapi/types.h>

namespace rtapi {

/// What an operation does. [DXR 2.0: D3D12_RTAS_OPERATION_TYPE]
enum class RtasOperationType : uint32_t {
  kMoveClusterObjects = 0,                  ///< copies of what the next four made
  kBuildBlasFromClas = 1,                   ///< a bottom level from clusters
  kBuildClasFromTriangles = 2,              ///< clusters from triangles
  kBuildClusterTemplatesFromTriangles = 3,  ///< clusters without positions
  kInstantiateClusterTemplates = 4,         ///< clusters from templates and positions
  kPartitionedTlas = 8,                     ///< a partitioned top level
};

/// Flags of partitioned top levels. The first two exclude each other (KA0748).
/// [DXR 2.0: D3D12_RTAS_PARTITIONED_TLAS_FLAGS]
enum class RtasPartitionedTlasFlags : uint32_t {
  kNone = 0,
  kFastTrace = 1,
  kFastBuild = 2,
  kEnablePartitionTranslation = 4,  ///< partitions have translations; without it they are zero
};
template <>
inline constexpr bool kIsFlags<RtasPartitionedTlasFlags> = true;

/// Inputs of kPartitionedTlas. [DXR 2.0: D3D12_RTAS_PARTITIONED_TLAS_INPUTS_DESC]
struct RtasPartitionedTlasInputsDesc {
  RtasPartitionedTlasFlags Flags = RtasPartitionedTlasFlags::kNone;  ///< may change between builds
  uint32_t InstanceCount = 0;                 ///< slots of instances, at most 2^24 (KA0748)
  uint32_t MaxInstancePerPartitionCount = 0;  ///< after all operations
  uint32_t PartitionCount = 0;                ///< without the global one; at most 2^24 (KA0748)
  uint32_t MaxInstanceInGlobalPartitionCount = 0;  ///< after all operations
};

/// Where the results of a batched operation go. [DXR 2.0: D3D12_RTAS_OPERATION_MODE]
enum class RtasOperationMode : uint32_t {
  kImplicitDestinations = 0,  ///< into BatchResultData, at addresses that the operation chooses
  kExplicitDestinations = 1,  ///< to the addresses of ResultAddressArray
  kGetSizes = 2,              ///< nowhere: only ResultSizeArray is written
};

/// Flags of operations on clusters. The first two are hints and exclude each other (KA0748).
/// [DXR 2.0: D3D12_RTAS_OPERATION_FLAGS]
enum class RtasOperationFlags : uint32_t {
  kNone = 0,
  kFastTrace = 4,
  kFastOperation = 8,
  kAllowDataAccess = 0x100,  ///< TriangleObjectPositions; not for kBuildBlasFromClas (KA0748)
  kAllowOmm = 0x400,         ///< the clusters may have opacity micromaps
};
template <>
inline constexpr bool kIsFlags<RtasOperationFlags> = true;

/// Vertices of clusters. Two components: z is 0. [DXR 2.0: D3D12_VERTEX_FORMAT]
enum class RtasVertexFormat : uint32_t {
  kNone = 0,               ///< for VertexHintFormat only
  kFloat32x2 = 1,          ///< 8 bytes
  kFloat32x3 = 2,          ///< 12 bytes
  kFloat16x2 = 3,          ///< 4 bytes
  kFloat16x3 = 4,          ///< 6 bytes
  kUnorm16x2 = 5,          ///< 4 bytes
  kUnorm16x3 = 6,          ///< 6 bytes
  kSnorm16x2 = 7,          ///< 4 bytes
  kSnorm16x3 = 8,          ///< 6 bytes
  kUnorm8x2 = 9,           ///< 2 bytes
  kUnorm8x3 = 10,          ///< 3 bytes
  kSnorm8x2 = 11,          ///< 2 bytes
  kSnorm8x3 = 12,          ///< 3 bytes
  k10_10_10_2_Unorm = 13,  ///< 4 bytes, the top two bits unused
  kCompressed1 = 14,       ///< a block: 12 bytes of anchors and bit counts, then offsets in bits
};

/// Indices of clusters: the value is their size in bytes. [DXR 2.0: D3D12_INDEX_FORMAT]
enum class RtasIndexFormat : uint32_t { kNone = 0, kUint8 = 1, kUint16 = 2, kUint32 = 4 };

/// Triangles, and vertices, of a cluster: at most this many.
inline constexpr uint32_t kRtasMaxClusterElements = 256;
/// Alignment in bytes of clusters and their destinations. [DXR 2.0: CLAS_BYTE_ALIGNMENT]
inline constexpr uint32_t kRtasClasByteAlignment = 128;
/// Alignment in bytes of cluster templates and of their bounding boxes.
/// [DXR 2.0: CLUSTER_TEMPLATE_BYTE_ALIGNMENT]
inline constexpr uint32_t kRtasClusterTemplateByteAlignment = 32;
/// The largest geometry index of a triangle. [DXR 2.0: MAXIMUM_GEOMETRY_INDEX]
inline constexpr uint32_t kRtasMaximumGeometryIndex = 16777215;

/// What bounds the arguments of an operation on clusters. [DXR 2.0: D3D12_RTAS_CLUSTER_LIMITS]
struct RtasClusterLimits {
  uint32_t MaxArgCount = 0;            ///< arguments
  uint32_t MaxGeometryIndexValue = 0;  ///< at most kRtasMaximumGeometryIndex (KA0748)
  uint32_t MaxUniqueGeometryIndexAndFlagsCountPerCluster = 0;  ///< pairs; 0 counts as 1
  uint32_t MaxTriangleCountPerCluster = 0;           ///< at most kRtasMaxClusterElements (KA0748)
  uint32_t MaxVertexCountPerCluster = 0;             ///< at most kRtasMaxClusterElements (KA0748)
  uint32_t MaxTotalTriangleCount = 0;                ///< of all arguments together
  uint32_t MaxTotalVertexCount = 0;                  ///< of all arguments together
  uint32_t MaxOpacityMicromapIndicesPerCluster = 0;  ///< special ones included
};

/// Inputs of kBuildClasFromTriangles. [DXR 2.0: D3D12_RTAS_CLUSTER_TRIANGLES_INPUTS_DESC]
struct RtasClusterTrianglesInputsDesc {
  RtasClusterLimits Limits = {};                                 ///< bounds of the arguments
  RtasOperationFlags Flags = RtasOperationFlags::kNone;          ///< of all clusters
  RtasOperationMode Mode = {};                                   ///< where the clusters go
  RtasVertexFormat VertexFormat = RtasVertexFormat::kFloat32x3;  ///< of VertexBuffer; not kNone
  RtasIndexFormat IndexFormat = RtasIndexFormat::kUint8;         ///< of IndexBuffer; not kNone
  RtasIndexFormat GeometryIndexAndFlagsIndexFormat = {};         ///< kNone: there are no indices
  RtasIndexFormat OpacityMicromapIndexFormat = {};               ///< kNone: there are no indices
  union {
    uint32_t MinPositionTruncateBitCount = 0;    ///< of all arguments
    uint32_t MaxCompressedClusterPositionsSize;  ///< kCompressed1: bytes of a block
  };
};

/// Inputs of kBuildClusterTemplatesFromTriangles.
/// [DXR 2.0: D3D12_RTAS_CLUSTER_TEMPLATE_TRIANGLES_INPUTS_DESC]
struct RtasClusterTemplateTrianglesInputsDesc {
  RtasClusterLimits Limits = {};                         ///< bounds of the arguments
  RtasOperationFlags Flags = RtasOperationFlags::kNone;  ///< of all templates
  RtasOperationMode Mode = {};                           ///< where the templates go
  RtasVertexFormat VertexHintFormat = {};                ///< of VertexBuffer, which is a hint
  RtasVertexFormat VertexInstantiationFormat = RtasVertexFormat::kFloat32x3;  ///< of instances
  RtasIndexFormat IndexFormat = RtasIndexFormat::kUint8;  ///< of IndexBuffer; not kNone
  RtasIndexFormat GeometryIndexAndFlagsIndexFormat = {};  ///< kNone: there are no indices
  RtasIndexFormat OpacityMicromapIndexFormat = {};        ///< kNone: there are no indices
};

/// Inputs of kInstantiateClusterTemplates.
/// [DXR 2.0: D3D12_RTAS_INSTANTIATE_CLUSTER_TEMPLATE_INPUTS_DESC]
struct RtasInstantiateClusterTemplateInputsDesc {
  RtasClusterLimits Limits = {};                         ///< bounds of the arguments
  RtasOperationFlags Flags = RtasOperationFlags::kNone;  ///< kAllowDataAccess is the template's
  RtasOperationMode Mode = {};                           ///< where the clusters go
  RtasVertexFormat VertexSourceFormat = RtasVertexFormat::kFloat32x3;  ///< of VertexBuffer
};

/// Inputs of kBuildBlasFromClas. [DXR 2.0: D3D12_RTAS_CLAS_INPUTS_DESC]
struct RtasClasInputsDesc {
  RtasOperationFlags Flags = RtasOperationFlags::kNone;  ///< of all bottom levels
  uint32_t MaxArgCount = 0;                              ///< arguments
  RtasOperationMode Mode = {};                           ///< where the bottom levels go
  uint32_t MaxTotalClasCount = 0;                        ///< of all arguments together
  uint32_t MaxClasCountPerArg = 0;                       ///< of each argument
};

/// What kMoveClusterObjects moves. [DXR 2.0: D3D12_RTAS_MOVE_OPERATION_TYPE]
enum class RtasMoveOperationType : uint32_t {
  kClusterBottomLevelAccelerationStructure = 0,
  kClusterLevelAccelerationStructure = 1,
  kClusterTemplate = 2,
};

/// Flags of moves. [DXR 2.0: D3D12_RTAS_CLUSTER_MOVE_OPERATION_FLAGS]
enum class RtasClusterMoveOperationFlags : uint32_t {
  kNone = 0,
  kNoOverlap = 0x200,  ///< no source overlaps a destination
  kAllowOmm = 0x400,   ///< the objects may have opacity micromaps
};
template <>
inline constexpr bool kIsFlags<RtasClusterMoveOperationFlags> = true;

/// Inputs of kMoveClusterObjects. [DXR 2.0: D3D12_RTAS_CLUSTER_MOVES_DESC]
struct RtasClusterMovesDesc {
  RtasClusterMoveOperationFlags Flags = RtasClusterMoveOperationFlags::kNone;  ///< of all moves
  uint32_t MaxArgCount = 0;                                                    ///< arguments
  RtasOperationMode Mode = {};      ///< where the copies go
  RtasMoveOperationType Type = {};  ///< of all sources
  uint64_t MaxBytesMoved = 0;       ///< of all objects together
};

/// What is done: the type, and the desc of that type in host memory, copied when the call is made.
/// [DXR 2.0: D3D12_RTAS_OPERATION_INPUTS]
struct RtasOperationInputs {
  RtasOperationType Type = RtasOperationType::kPartitionedTlas;  ///< what is done
  union {
    const RtasPartitionedTlasInputsDesc* pPartitionedTLASInputsDesc =
        nullptr;                                                  ///< kPartitionedTlas
    const RtasClasInputsDesc* pClasDesc;                          ///< kBuildBlasFromClas
    const RtasClusterTrianglesInputsDesc* pClusterTrianglesDesc;  ///< kBuildClasFromTriangles
    /// kBuildClusterTemplatesFromTriangles.
    const RtasClusterTemplateTrianglesInputsDesc* pClusterTemplateTrianglesDesc;
    /// kInstantiateClusterTemplates.
    const RtasInstantiateClusterTemplateInputsDesc* pInstantiateClusterTemplateDesc;
    const RtasClusterMovesDesc* pClusterMovesDesc;  ///< kMoveClusterObjects
  };
};

/// Bytes that an operation needs. [DXR 2.0: D3D12_RTAS_OPERATION_PREBUILD_INFO]
struct RtasOperationPrebuildInfo {
  /// Bytes for all results with kImplicitDestinations, for the largest one with
  /// kExplicitDestinations; 0 with kGetSizes and for kMoveClusterObjects.
  uint64_t ResultDataMaxSizeInBytes = 0;
  uint64_t ScratchDataSizeInBytes = 0;  ///< of scratch memory
};

/// The memory of a build of a partitioned top level.
/// [DXR 2.0: D3D12_RTAS_PARTITIONED_TLAS_OPERATION_DATA]
struct RtasPartitionedTlasOperationData {
  /// What the operations change: a partitioned top level, which stays as it is unless it is also
  /// the destination; 0: one of zeros.
  GpuVirtualAddress SourceAccelerationStructureData = 0;
  GpuVirtualAddress DestAccelerationStructureData = 0;     ///< a multiple of 256
  GpuVirtualAddress ScratchAccelerationStructureData = 0;  ///< a multiple of 256
  GpuVirtualAddress IndirectPartitionedTlasOpCount = 0;    ///< of a uint32_t; not 0
  GpuVirtualAddress IndirectPartitionedTlasOps = 0;        ///< RtasPartitionedTlasOperation
};

/// Which addresses of RtasBatchedOperationData are those of an 8-byte aligned uint64_t with the
/// address proper, which is read when the operation executes.
/// [DXR 2.0: D3D12_RTAS_OPERATION_ADDRESS_RESOLUTION_FLAGS]
enum class RtasOperationAddressResolutionFlags : uint32_t {
  kNone = 0,
  kIndirectedBatchResult = 1,
  kIndirectedBatchScratch = 2,
  kIndirectedDestinationAddressArray = 4,  ///< ResultAddressArray
  kIndirectedResultSizeArray = 8,
  kIndirectedIndirectArgumentArray = 0x10,
  kIndirectedIndirectArgumentCount = 0x20,  ///< IndirectArgumentArraySize
};
template <>
inline constexpr bool kIsFlags<RtasOperationAddressResolutionFlags> = true;

/// The memory of an operation with many arguments: of all types but kPartitionedTlas. Strides of 0
/// mean arrays without gaps; others are multiples of 8 (KA0749).
/// [DXR 2.0: D3D12_RTAS_BATCHED_OPERATION_DATA]
struct RtasBatchedOperationData {
  /// Which addresses are read from GPU memory.
  RtasOperationAddressResolutionFlags AddressResolutionFlags =
      RtasOperationAddressResolutionFlags::kNone;
  /// kImplicitDestinations: where the results go, aligned as they are: clusters 128, bottom levels
  /// 256, templates 32. Otherwise ignored.
  GpuVirtualAddress BatchResultData = 0;
  GpuVirtualAddress BatchScratchData = 0;  ///< a multiple of 256
  /// uint64_t addresses of the results, 0 for an argument that was left out: written with
  /// kImplicitDestinations (0: nowhere), read with kExplicitDestinations, otherwise ignored.
  GpuVirtualAddressAndStride ResultAddressArray = {};
  /// uint64_t sizes of the results in bytes, 0 for an argument that was left out. 0: not written,
  /// which kGetSizes refuses (KA0749).
  GpuVirtualAddressAndStride ResultSizeArray = {};
  GpuVirtualAddressAndStride IndirectArgumentArray = {};  ///< of the type's structs
  /// Address of a uint32_t, the number of arguments, of which MaxArgCount count; 0: MaxArgCount.
  GpuVirtualAddress IndirectArgumentArraySize = 0;
  /// 0, or where tools find uint64_t numbers: of the results, their sizes and, but for kGetSizes,
  /// their addresses.
  GpuVirtualAddress ToolsInfo = 0;
};

/// One operation of ExecuteIndirectRTASOperations. [DXR 2.0: D3D12_RTAS_OPERATION_DESC]
struct RtasOperationDesc {
  const RtasOperationInputs* pInputs = nullptr;  ///< in host memory, copied when the call is made
  /// The memory that it works on. In host memory, copied when the call is made.
  union {
    const RtasPartitionedTlasOperationData* pPartitionedTlasOperationData = nullptr;
    const RtasBatchedOperationData* pBatchedOperationData;  ///< of all types but kPartitionedTlas
  };
};

/// None are defined. [DXR 2.0: D3D12_EXECUTE_INDIRECT_RTAS_OPERATIONS_FLAGS]
enum class ExecuteIndirectRtasOperationsFlags : uint32_t { kNone = 0 };

/// What an operation on a partitioned top level does.
/// [DXR 2.0: D3D12_RTAS_PARTITIONED_TLAS_OPERATION_TYPE]
enum class RtasPartitionedTlasOperationType : uint32_t {
  kWriteInstance = 0,
  kUpdateInstance = 1,
  kTranslatePartition = 2,
};

/// One operation on a partitioned top level, in GPU memory; at most one of each type.
/// [DXR 2.0: D3D12_RTAS_PARTITIONED_TLAS_OPERATION]
struct RtasPartitionedTlasOperation {
  /// What the arguments are.
  RtasPartitionedTlasOperationType Type = RtasPartitionedTlasOperationType::kWriteInstance;
  uint32_t ArgCount = 0;                    ///< arguments
  GpuVirtualAddressAndStride ArgData = {};  ///< stride 0: without gaps
};

/// PartitionIndex of the global partition, which is no part of PartitionCount.
/// [DXR 2.0: D3D12_RTAS_PARTITION_INDEX_GLOBAL_PARTITION]
inline constexpr uint32_t kRtasPartitionIndexGlobalPartition = 0xFFFFFFFF;

/// Those of RaytracingInstanceFlags, with the same values, and one more.
/// [DXR 2.0: D3D12_RTAS_PARTITIONED_TLAS_INSTANCE_FLAGS]
enum class RtasPartitionedTlasInstanceFlags : uint32_t {
  kNone = 0,
  kTriangleCullDisable = 0x1,
  kTriangleFrontCounterclockwise = 0x2,
  kForceOpaque = 0x4,
  kForceNonOpaque = 0x8,
  kForceOmm2State = 0x10,
  kDisableOmms = 0x20,
  kEnableExplicitAabb = 0x40,  ///< ExplicitAABB bounds all that the instance will ever be
};
template <>
inline constexpr bool kIsFlags<RtasPartitionedTlasInstanceFlags> = true;

/// An argument of kWriteInstance, in GPU memory: replaces the whole instance.
/// [DXR 2.0: D3D12_RTAS_PARTITIONED_TLAS_WRITE_INSTANCE_ARGS]
struct RtasPartitionedTlasWriteInstanceArgs {
  /// From object to world space, 3 x 4 floats, row-major, before the partition's translation.
  float Transform[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  uint32_t InstanceID = 0;                           ///< all 32 bits
  uint32_t InstanceMask = 0xFF;                      ///< at most 255
  uint32_t InstanceContributionToHitGroupIndex = 0;  ///< below 2^24
  /// Culling, facing and opacity.
  RtasPartitionedTlasInstanceFlags InstanceFlags = RtasPartitionedTlasInstanceFlags::kNone;
  GpuVirtualAddress AccelerationStructure = 0;  ///< of a bottom level; 0: disabled
  uint32_t InstanceIndex = 0;                   ///< below InstanceCount; what shaders read
  uint32_t PartitionIndex = 0;                  ///< below PartitionCount, or the global one
  RaytracingAabb ExplicitAABB = {};             ///< after Transform, before any translation
};

/// An argument of kUpdateInstance, in GPU memory: replaces two members of the instance.
/// [DXR 2.0: D3D12_RTAS_PARTITIONED_TLAS_UPDATE_INSTANCE_ARGS]
struct RtasPartitionedTlasUpdateInstanceArgs {
  uint32_t InstanceIndex = 0;                        ///< below InstanceCount
  uint32_t InstanceContributionToHitGroupIndex = 0;  ///< below 2^24
  GpuVirtualAddress AccelerationStructure = 0;       ///< of a bottom level; not 0
};

/// An argument of kTranslatePartition, in GPU memory: replaces the partition's translation.
/// [DXR 2.0: D3D12_RTAS_PARTITIONED_TLAS_TRANSLATE_PARTITION_ARGS]
struct RtasPartitionedTlasTranslatePartitionArgs {
  uint32_t PartitionIndex = 0;                ///< below PartitionCount, or the global one
  float PartitionTranslation[3] = {0, 0, 0};  ///< added to the transforms of its instances
};

/// Flags of a cluster. [DXR 2.0: D3D12_RTAS_CLUSTER_OPERATION_CLAS_FLAGS]
enum class RtasClusterFlags : uint32_t {
  kNone = 0,
  kAllowDisableOmms = 1,    ///< instances may have kDisableOmms
  kDisallowDataAccess = 2,  ///< takes kAllowDataAccess from this one
};
template <>
inline constexpr bool kIsFlags<RtasClusterFlags> = true;

/// The top byte of a geometry index in GPU memory: flags of the triangle.
/// [DXR 2.0: D3D12_RTAS_CLUSTERED_GEOMETRY_FLAGS]
///@{
inline constexpr uint32_t kRtasClusteredGeometryNoDuplicateAnyHitInvocation = 0x40000000;
inline constexpr uint32_t kRtasClusteredGeometryOpaque = 0x80000000;
///@}

/// An argument of kBuildClasFromTriangles, in GPU memory. Strides are in bytes; 0: without gaps.
/// [DXR 2.0: D3D12_RTAS_OPERATION_BUILD_CLAS_FROM_TRIANGLES_ARGS]
struct RtasBuildClasFromTrianglesArgs {
  uint32_t ClusterID = 0;                                   ///< what shaders read
  RtasClusterFlags ClusterFlags = RtasClusterFlags::kNone;  ///< of this cluster
  uint16_t TriangleCount = 0;                               ///< 0: nothing can be hit
  uint16_t VertexCount = 0;                                 ///< that indices may name
  uint32_t BaseGeometryIndexAndFlags = 0;                   ///< added to those of the array
  uint32_t OpacityMicromapBaseLocation = 0;          ///< added to indices that are not special
  uint16_t VertexBufferStride = 0;                   ///< a multiple of a component
  uint16_t IndexBufferStride = 0;                    ///< a multiple of an index, at most 4
  uint16_t OpacityMicromapIndexBufferStride = 0;     ///< a multiple of an index
  uint16_t GeometryIndexAndFlagsArrayStride = 0;     ///< a multiple of 4
  uint16_t PositionTruncateBitCount = 0;             ///< low bits of floats to zero; at most 32
  uint16_t Reserved = 0;                             ///< ignored
  GpuVirtualAddress VertexBuffer = 0;                ///< of the inputs' format
  GpuVirtualAddress IndexBuffer = 0;                 ///< 3 for each triangle
  GpuVirtualAddress GeometryIndexAndFlagsArray = 0;  ///< of uint32_t; 0: the base is all
  GpuVirtualAddress GeometryIndexAndFlagsIndexBuffer = 0;  ///< 1 for each triangle, without gaps
  GpuVirtualAddress OpacityMicromapArray = 0;              ///< of a micromap array
  GpuVirtualAddress OpacityMicromapIndexBuffer = 0;        ///< 1 for each triangle
};

/// An argument of kBuildClusterTemplatesFromTriangles, in GPU memory.
/// [DXR 2.0: D3D12_RTAS_OPERATION_BUILD_CLUSTER_TEMPLATES_FROM_TRIANGLES_ARGS]
struct RtasBuildClusterTemplatesFromTrianglesArgs {
  RtasBuildClasFromTrianglesArgs TrianglesArgs = {};  ///< VertexBuffer is a hint, and may be 0
  union {
    /// 0, or of 6 floats, the least and the largest x, y, z of all vertices of all instances; a
    /// multiple of 32.
    GpuVirtualAddress InstantiationBoundingBoxLimit = 0;
    /// With VertexInstantiationFormat kCompressed1: the exponent in bits 0 to 7, then the numbers
    /// of bits of x, y and z less one in 4 bits each.
    uint32_t Compressed1TemplateHeader;
  };
};

/// An argument of kInstantiateClusterTemplates, in GPU memory.
/// [DXR 2.0: D3D12_RTAS_OPERATION_INSTANTIATE_CLUSTER_TEMPLATES_ARGS]
struct RtasInstantiateClusterTemplatesArgs {
  int32_t GeometryIndexOffset = 0;               ///< added to the template's geometry indices
  uint32_t ClusterIdOffset = 0;                  ///< added to the template's ClusterID, mod 2^32
  GpuVirtualAddress ClusterTemplate = 0;         ///< a template
  GpuVirtualAddressAndStride VertexBuffer = {};  ///< of VertexSourceFormat
};

/// An argument of kBuildBlasFromClas, in GPU memory.
/// [DXR 2.0: D3D12_RTAS_OPERATION_BUILD_BLAS_FROM_CLAS_ARGS]
struct RtasBuildBlasFromClasArgs {
  uint32_t ClasAddressCount = 0;           ///< 0: nothing can be hit
  uint32_t ClasAddressStride = 0;          ///< bytes, a multiple of 8; 0: without gaps
  GpuVirtualAddress ClasAddressArray = 0;  ///< of uint64_t addresses of clusters; 0 is ignored
};

/// An argument of kMoveClusterObjects, in GPU memory.
/// [DXR 2.0: D3D12_RTAS_OPERATION_MOVE_CLUSTER_OBJECTS_ARGS]
struct RtasMoveClusterObjectsArgs {
  GpuVirtualAddress SourceAccelerationStructure = 0;  ///< of the inputs' Type
};

// The layouts of specification 0.28 on x86-64.
static_assert(sizeof(RtasPartitionedTlasInputsDesc) == 20);
static_assert(sizeof(RtasClusterLimits) == 32);
static_assert(sizeof(RtasClusterTrianglesInputsDesc) == 60);
static_assert(offsetof(RtasClusterTrianglesInputsDesc, VertexFormat) == 40);
static_assert(sizeof(RtasClusterTemplateTrianglesInputsDesc) == 60);
static_assert(offsetof(RtasClusterTemplateTrianglesInputsDesc, IndexFormat) == 48);
static_assert(sizeof(RtasInstantiateClusterTemplateInputsDesc) == 44);
static_assert(sizeof(RtasClasInputsDesc) == 20);
static_assert(sizeof(RtasClusterMovesDesc) == 24);
static_assert(sizeof(RtasOperationInputs) == 16);
static_assert(sizeof(RtasOperationPrebuildInfo) == 16);
static_assert(sizeof(RtasPartitionedTlasOperationData) == 40);
static_assert(sizeof(RtasBatchedOperationData) == 88);
static_assert(offsetof(RtasBatchedOperationData, IndirectArgumentArray) == 56);
static_assert(sizeof(RtasOperationDesc) == 16);
static_assert(sizeof(RtasPartitionedTlasOperation) == 24);
static_assert(sizeof(RtasPartitionedTlasWriteInstanceArgs) == 104);
static_assert(offsetof(RtasPartitionedTlasWriteInstanceArgs, AccelerationStructure) == 64);
static_assert(offsetof(RtasPartitionedTlasWriteInstanceArgs, ExplicitAABB) == 80);
static_assert(sizeof(RtasPartitionedTlasUpdateInstanceArgs) == 16);
static_assert(sizeof(RtasPartitionedTlasTranslatePartitionArgs) == 16);
static_assert(sizeof(RtasBuildClasFromTrianglesArgs) == 80);
static_assert(offsetof(RtasBuildClasFromTrianglesArgs, VertexBufferStride) == 20);
static_assert(offsetof(RtasBuildClasFromTrianglesArgs, VertexBuffer) == 32);
static_assert(offsetof(RtasBuildClasFromTrianglesArgs, OpacityMicromapIndexBuffer) == 72);
static_assert(sizeof(RtasBuildClusterTemplatesFromTrianglesArgs) == 88);
static_assert(sizeof(RtasInstantiateClusterTemplatesArgs) == 32);
static_assert(offsetof(RtasInstantiateClusterTemplatesArgs, VertexBuffer) == 16);
static_assert(sizeof(RtasBuildBlasFromClasArgs) == 16);
static_assert(sizeof(RtasMoveClusterObjectsArgs) == 8);

}  // namespace rtapi
