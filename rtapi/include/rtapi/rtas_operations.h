// SPDX-License-Identifier: MIT
/// @file
/// EXPERIMENTAL: acceleration structure operations whose arguments lie in GPU memory; so far
/// partitioned top levels. Names, numbers and layouts are those of the specification of DXR 2.0,
/// version 0.28, which still moves; all that depends on it is here. A device has them where
/// DeviceDesc::IndirectRtasOperations asks for it.
/// [DXR 2.0: ExecuteIndirectRTASOperations]
#pragma once

#include <cstddef>
#include <cstdint>

#include <rtapi/raytracing.h>
#include <rtapi/types.h>

namespace rtapi {

/// What an operation does. [DXR 2.0: D3D12_RTAS_OPERATION_TYPE]
enum class RtasOperationType : uint32_t {
  kMoveClusterObjects = 0,                  ///< not offered yet (KA0748), like all but the last
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

/// What is done: the type, and the desc of that type in host memory, copied when the call is made.
/// [DXR 2.0: D3D12_RTAS_OPERATION_INPUTS]
struct RtasOperationInputs {
  RtasOperationType Type = RtasOperationType::kPartitionedTlas;               ///< what is done
  const RtasPartitionedTlasInputsDesc* pPartitionedTLASInputsDesc = nullptr;  ///< kPartitionedTlas
};

/// Bytes that an operation needs. [DXR 2.0: D3D12_RTAS_OPERATION_PREBUILD_INFO]
struct RtasOperationPrebuildInfo {
  uint64_t ResultDataMaxSizeInBytes = 0;  ///< of the structure
  uint64_t ScratchDataSizeInBytes = 0;    ///< of scratch memory
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

/// One operation of ExecuteIndirectRTASOperations. [DXR 2.0: D3D12_RTAS_OPERATION_DESC]
struct RtasOperationDesc {
  const RtasOperationInputs* pInputs = nullptr;  ///< in host memory, copied when the call is made
  /// The addresses that kPartitionedTlas works on. In host memory, copied when the call is made.
  const RtasPartitionedTlasOperationData* pPartitionedTlasOperationData = nullptr;
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

// The layouts of specification 0.28 on x86-64.
static_assert(sizeof(RtasPartitionedTlasInputsDesc) == 20);
static_assert(sizeof(RtasOperationInputs) == 16);
static_assert(sizeof(RtasOperationPrebuildInfo) == 16);
static_assert(sizeof(RtasPartitionedTlasOperationData) == 40);
static_assert(sizeof(RtasOperationDesc) == 16);
static_assert(sizeof(RtasPartitionedTlasOperation) == 24);
static_assert(sizeof(RtasPartitionedTlasWriteInstanceArgs) == 104);
static_assert(offsetof(RtasPartitionedTlasWriteInstanceArgs, AccelerationStructure) == 64);
static_assert(offsetof(RtasPartitionedTlasWriteInstanceArgs, ExplicitAABB) == 80);
static_assert(sizeof(RtasPartitionedTlasUpdateInstanceArgs) == 16);
static_assert(sizeof(RtasPartitionedTlasTranslatePartitionArgs) == 16);

}  // namespace rtapi
