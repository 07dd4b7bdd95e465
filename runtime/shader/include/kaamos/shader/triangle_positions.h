// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL, as shader model 6.10 is: the vertices of the triangle that was hit, for shaders
// that read them. [DXR: TriangleObjectPositions]
//
// A shader passes on where the positions of the hit's bottom level are as a uint2, its position
// table: on the CPU the address of an array of GeometryPositions, in SPIR-V that of
// spirv::PositionTable. {0, 0}: the hit is no triangle, or there is none. A hit object of a
// triangle has it in the last two words of its attributes, which triangles leave free.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/stage.h"
#include "kaamos/shader/vector.h"

namespace kaamos::shader {

// One for each geometry of a bottom level.
struct GeometryPositions {
  const float* xyz = nullptr;         // of each vertex, in object space; null: no triangles
  const uint32_t* indices = nullptr;  // null: 0, 1, 2, ...
  bool is_readable = false;           // it was built with ALLOW_DATA_ACCESS
};

// What RaySystemValues::world_to_object and RayQueryHit::world_to_object point to.
struct InstanceTransform {
  float rows[12];                      // 3x4, row-major
  const GeometryPositions* positions;  // of the bottom level; null: there is none
  uint32_t instance_id;
};

inline constexpr uint32_t kHitPositionTable = 6;  // its first word in HitObject::attributes
inline constexpr uint32_t kLeastTriangleHitKind = 254;

KAAMOS_INLINE uint2 position_table(const float* world_to_object) {
  if (world_to_object == nullptr) return {};
  const auto* transform = reinterpret_cast<const InstanceTransform*>(world_to_object);
  const auto address = reinterpret_cast<uint64_t>(transform->positions);
  return {{static_cast<uint32_t>(address), static_cast<uint32_t>(address >> 32)}};
}

inline void set_position_table(HitObject& hit, const GeometryPositions* positions) {
  __builtin_memcpy(&hit.attributes[kHitPositionTable], &positions, sizeof(positions));
}
inline const GeometryPositions* positions_of(const HitObject& hit) {
  const GeometryPositions* positions = nullptr;
  if (hit.state == kHitObjectHit && hit.hit_kind >= kLeastTriangleHitKind) {
    __builtin_memcpy(&positions, &hit.attributes[kHitPositionTable], sizeof(positions));
  }
  return positions;
}

inline const GeometryPositions* geometry_positions(uint2 table, uint32_t geometry) {
  const uint64_t address = table[0] | uint64_t{table[1]} << 32;
  if (address == 0) return nullptr;
  const GeometryPositions* found = reinterpret_cast<const GeometryPositions*>(address) + geometry;
  return found->xyz != nullptr ? found : nullptr;
}

// Row by row, in the order of the build. Zeros if the hit is no triangle.
inline float3x3 triangle_positions(uint2 table, uint32_t geometry, uint32_t primitive) {
  float3x3 result = {};
  const GeometryPositions* positions = geometry_positions(table, geometry);
  if (positions == nullptr) return result;
  for (uint32_t i = 0; i < 3; ++i) {
    const uint64_t corner = 3 * uint64_t{primitive} + i;
    const uint64_t vertex = positions->indices != nullptr ? positions->indices[corner] : corner;
    for (uint32_t axis = 0; axis < 3; ++axis) result[i][axis] = positions->xyz[3 * vertex + axis];
  }
  return result;
}

// More findings of checked libraries. Values: geometry, primitive.
inline constexpr auto kNoTriangle = static_cast<Finding>(64);    // the hit has no positions
inline constexpr auto kNoDataAccess = static_cast<Finding>(65);  // built without ALLOW_DATA_ACCESS

namespace checked {

inline float3x3 triangle_positions(Invocation& invocation, uint32_t site, uint2 table,
                                   uint32_t geometry, uint32_t primitive) {
  const GeometryPositions* positions = geometry_positions(table, geometry);
  if (positions == nullptr || !positions->is_readable) {
    const auto tell = invocation.dispatch->services->report;
    CheckReport found;
    found.finding = positions == nullptr ? kNoTriangle : kNoDataAccess;
    found.site = site;
    found.values[0] = geometry;
    found.values[1] = primitive;
    if (tell != nullptr) tell(invocation, found);
  }
  return shader::triangle_positions(table, geometry, primitive);
}

}  // namespace checked

}  // namespace kaamos::shader
