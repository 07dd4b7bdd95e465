// SPDX-License-Identifier: MIT
//
// Instance records as a top level build reads them from GPU memory, and which of them can be hit.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

// Coordinates whose square still fits into a float: traversals take no larger ones.
inline constexpr float kLargestCoordinate = 1.8e18f;

// D3D12_RAYTRACING_INSTANCE_FLAGS
enum InstanceFlags : uint32_t {
  kInstanceTriangleCullDisable = 1,
  kInstanceTriangleFrontCounterclockwise = 2,
  kInstanceForceOpaque = 4,
  kInstanceForceNonOpaque = 8,
};

struct Instance {
  rtapi::RaytracingInstanceDesc desc;
  // Null: never hit, but it keeps its index.
  std::shared_ptr<BottomLevelBase> bottom_level;
  float world_to_object[12] = {};  // 3x4, row-major; of active ones
  Bounds bounds;                   // in world space; of active ones
};

// The instances of a build in the order of the input: the position is InstanceIndex. Instances
// without a bottom level, with a singular or non-finite matrix, or of an empty bottom level are
// inactive; those that are not plainly so get a message KA0797. Error KA0796: records outside the
// living allocations.
rtapi::Result<std::vector<Instance>> read_instances(const StructureEnvironment& environment,
                                                    const BuildCommand& command);

// Deserialization of a top level may come before that of its bottom levels: those are inactive
// without a message then.
enum class InstanceNotes { kAll, kMissingMayCome };

// The same from records that were read already; `top_level` is the address for messages.
std::vector<Instance> activate_instances(const StructureEnvironment& environment,
                                         uint64_t top_level,
                                         std::span<const rtapi::RaytracingInstanceDesc> descs,
                                         InstanceNotes notes);

// The records of the instances, for AccelerationStructure::instances.
std::shared_ptr<const std::vector<rtapi::RaytracingInstanceDesc>> records_of(
    std::span<const Instance> instances);

// world_to_object of a 3x4 row-major matrix, inverted in double; false if singular, or if it or the
// inverse is not finite in float.
bool invert_transform(const float matrix[12], float inverse[12]);

// World bounds of an object-space box. Widened by the rounding of the ray transform: a ray that
// touches the geometry in object space must not miss the box in world space. False if the box
// leaves the range of coordinates.
bool world_bounds(const float matrix[12], const Bounds& object, Bounds& world);

}  // namespace kaamos::runtime
