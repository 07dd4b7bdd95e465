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
#include "runtime/structures/instances.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

// How a backend builds what was deserialized. Both set compacted_bytes as a BuildLevel does.
struct RebuildLevel {
  // `geometries` have addresses of the host, all valid. The level takes `shapes` for its own, so
  // that updates are held against the first build's formats.
  std::function<rtapi::Status(std::span<const rtapi::RaytracingGeometryDesc> geometries,
                              std::span<const GeometryShape> shapes, AccelerationStructure& result)>
      bottom_level;
  std::function<rtapi::Status(const std::vector<Instance>& instances,
                              AccelerationStructure& result)>
      top_level;
};

// Errors: KA0796 no acceleration structure at the source, or compaction without its flag; KA0795:
// destination too small; KA0789: serialized data that cannot be read, with parse_serialized.
rtapi::Status copy_structure(const StructureEnvironment& environment,
                             const CopyAccelerationStructureCommand& command,
                             const RebuildLevel& rebuild);

// Before a dispatch: builds deserialized top levels again whose bottom levels came after them, in
// whatever order. [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE] What is still missing is
// inactive, with a message KA0797 once.
rtapi::Status complete_top_levels(const StructureEnvironment& environment,
                                  const RebuildLevel& rebuild);

}  // namespace kaamos::runtime
