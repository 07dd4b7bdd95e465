// SPDX-License-Identifier: MIT
//
// Instance records as a top-level build reads them from GPU memory, and which of them can be hit.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

// The largest coordinate whose square still fits into a float: traversals take none larger.
inline constexpr float kLargestCoordinate = 1.8e18f;

// D3D12_RAYTRACING_INSTANCE_FLAGS
enum InstanceFlags : uint32_t {
  kInstanceTriangleCullDisable = 1,
  kInstanceTriangleFrontCounterclockwise = 2,
  kInstanceForceOpaque = 4,
  kInstanceForceNonOpaque = 8,
  kInstanceForceOmm2State = 16,
  kInstanceDisableOmms = 32,
};

struct Instance {
  rtapi::RaytracingInstanceDesc desc;
  uint32_t id = 0;  // InstanceID: that of desc, but for partitioned top levels, where it is wider
  // Null: never hit, but still counted in InstanceIndex.
  std::shared_ptr<BottomLevelBase> bottom_level;
  float world_to_object[12] = {};  // 3x4, row-major; only if active
  Bounds bounds;                   // in world space; only if active
};

// The instances of a build in input order, so that the position is InstanceIndex. An instance is
// inactive if it has no bottom level or an empty one, or if its matrix is singular or not finite;
// unless that was clearly intended, message KA0797 says so. Error KA0796: records outside the live
// allocations.
rtapi::Result<std::vector<Instance>> read_instances(const StructureEnvironment& environment,
                                                    const BuildCommand& command);

// Finds the bottom level and computes what depends on it. Returns why the instance is inactive, if
// that was not clearly intended; otherwise null.
const char* activate_instance(const StructureMap& structures, Instance& instance);

// A top level may be deserialized before its bottom levels; those that are missing then make the
// instance inactive without a message.
enum class InstanceNotes { kAll, kMissingMayCome };

// The same from records that have already been read; `top_level` is the address to give in
// messages.
std::vector<Instance> activate_instances(const StructureEnvironment& environment,
                                         uint64_t top_level,
                                         std::span<const rtapi::RaytracingInstanceDesc> descs,
                                         InstanceNotes notes);

// The records of the instances, for AccelerationStructure::instances.
std::shared_ptr<const std::vector<rtapi::RaytracingInstanceDesc>> records_of(
    std::span<const Instance> instances);

// Computes world_to_object from a 3x4 row-major matrix, inverting in double; false if it is
// singular, or if it or its inverse is not finite in float.
bool invert_transform(const float matrix[12], float inverse[12]);

// World bounds of an object-space box, widened by the rounding of the ray transform: a ray that
// touches the geometry in object space must not miss the box in world space. False if the box
// exceeds the range of coordinates.
bool world_bounds(const float matrix[12], const Bounds& object, Bounds& world);

}  // namespace kaamos::runtime
