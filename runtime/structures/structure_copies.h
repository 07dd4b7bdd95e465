// SPDX-License-Identifier: MIT
//
// Copies of acceleration structures in every mode. [DXR: CopyRaytracingAccelerationStructure]
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/backend/commands.h"
#include "runtime/structures/clustered_geometry.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

// A partitioned top level, and what an operation changed of it.
struct PartitionedInstances {
  std::span<const Instance> instances;  // by InstanceIndex
  std::span<const uint32_t> changed;    // since the level was built; each once
  uint32_t partition_count = 0;         // with the global partition, which is the last
  bool prefers_trace = false;           // kFastTrace: rays count for more than the next operations
  // Takes an InstanceIndex, of an instance that can be hit.
  std::function<uint32_t(uint32_t instance)> partition_of;
};

// The functions by which a backend builds what does not come from a BuildCommand: what was
// deserialized, partitioned top levels, and bottom levels of clusters. All set compacted_bytes as a
// BuildLevel does.
struct RebuildLevel {
  // `geometries` have host addresses, all valid. The level adopts `shapes`, so that updates are
  // checked against the formats of the first build.
  std::function<rtapi::Status(std::span<const rtapi::RaytracingGeometryDesc> geometries,
                              std::span<const GeometryShape> shapes, AccelerationStructure& result)>
      bottom_level;
  std::function<rtapi::Status(const std::vector<Instance>& instances,
                              AccelerationStructure& result)>
      top_level;
  // A partitioned top level. result.top_level is the level that it was before, to be changed, or
  // null. Null: the backend has only whole top levels.
  std::function<rtapi::Status(const PartitionedInstances& instances, AccelerationStructure& result)>
      partitioned_level;
  // By the entries' order in GeometryContents and linkages, whatever their GeometryIndex.
  std::function<rtapi::Status(std::vector<ClusteredGeometry> geometries,
                              AccelerationStructure& result)>
      clustered_level;
};

// Errors: KA0796: no acceleration structure at the source, compaction without its flag, or a mode
// that its type does not have; KA0795: destination too small; KA0789: serialized data that cannot
// be read, from parse_serialized.
rtapi::Status copy_structure(const StructureEnvironment& environment,
                             const CopyAccelerationStructureCommand& command,
                             const RebuildLevel& rebuild);

// To be called before a dispatch: rebuilds what was deserialized before what it refers to, bottom
// levels of clusters and top levels, since any order is allowed. [DXR:
// D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE] What is still missing is left out and reported
// once, as KA0788 and KA0797.
rtapi::Status complete_structures(const StructureEnvironment& environment,
                                  const RebuildLevel& rebuild);

}  // namespace kaamos::runtime
