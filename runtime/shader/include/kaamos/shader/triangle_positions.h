// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL, as shader model 6.10 is: the vertices of the triangle that was hit, and the ID of
// its cluster, for shaders that read them. [DXR: TriangleObjectPositions, ClusterID]
//
// A shader passes on where they are as a uint2, the hit's position table. On the CPU it is the
// address of an array of GeometryPositions, or for a triangle in a cluster the address of its
// ClusterTriangle, marked by kInCluster; for SPIR-V see spirv_interface.h. {0, 0}: the hit is no
// triangle, or there is none. A hit object of a triangle has it in the last two words of its
// attributes, which triangles leave free.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/stage.h"
#include "kaamos/shader/vector.h"

namespace kaamos::shader {

// A triangle of a bottom level that was built from clusters: what backends know by their own
// numbers of geometry and primitive, since the application's are neither dense nor unique.
struct ClusterTriangle {
  const struct GeometryPositions* geometry = nullptr;
  uint32_t triangle = 0;         // in that geometry
  uint32_t geometry_index = 0;   // GeometryIndex
  uint32_t primitive_index = 0;  // PrimitiveIndex: its number in its cluster
  uint32_t cluster_id = 0;
};
inline constexpr uint64_t kInCluster = 1;            // in the address of a ClusterTriangle
inline constexpr uint32_t kNoCluster = 0xFFFFFFFFu;  // CLUSTER_ID_INVALID

// One for each geometry of a bottom level.
struct GeometryPositions {
  const float* xyz = nullptr;         // of each vertex, in object space; null: no triangles
  const uint32_t* indices = nullptr;  // null: 0, 1, 2, ...
  bool is_readable = false;           // it was built with ALLOW_DATA_ACCESS
  const ClusterTriangle* clustered = nullptr;  // by triangle, in a bottom level of clusters
};

// What RaySystemValues::world_to_object and RayQueryHit::world_to_object point to.
struct InstanceTransform {
  float rows[12];      // 3x4, row-major
  uint64_t positions;  // the position table as one number
  uint32_t instance_id;
};

inline uint64_t table_of(const GeometryPositions* positions) {
  return reinterpret_cast<uint64_t>(positions);
}
inline uint64_t table_of(const ClusterTriangle* triangle) {
  return reinterpret_cast<uint64_t>(triangle) | kInCluster;
}
KAAMOS_INLINE const ClusterTriangle* cluster_triangle(uint64_t table) {
  if ((table & kInCluster) == 0) return nullptr;
  return reinterpret_cast<const ClusterTriangle*>(table & ~kInCluster);
}

inline constexpr uint32_t kHitPositionTable = 6;  // its first word in HitObject::attributes
inline constexpr uint32_t kLeastTriangleHitKind = 254;

// The position table that belongs to a transform, as one number.
KAAMOS_INLINE uint64_t table_at(const float* world_to_object) {
  return reinterpret_cast<const InstanceTransform*>(world_to_object)->positions;
}
KAAMOS_INLINE uint2 as_words(uint64_t table) {
  return {{static_cast<uint32_t>(table), static_cast<uint32_t>(table >> 32)}};
}
KAAMOS_INLINE uint64_t as_number(uint2 table) {
  return table[0] | uint64_t{table[1]} << 32;
}
KAAMOS_INLINE uint2 position_table(const float* world_to_object) {
  if (world_to_object == nullptr) return {};
  return as_words(table_at(world_to_object));
}
KAAMOS_INLINE uint2 query_position_table(const RayQueryHit& hit) {
  return hit.cluster != nullptr ? as_words(table_of(hit.cluster))
                                : position_table(hit.world_to_object);
}

inline void set_position_table(HitObject& hit, uint64_t table) {
  __builtin_memcpy(&hit.attributes[kHitPositionTable], &table, sizeof(table));
}
inline uint64_t position_table_of(const HitObject& hit) {
  uint64_t table = 0;
  if (hit.state == kHitObjectHit && hit.hit_kind >= kLeastTriangleHitKind) {
    __builtin_memcpy(&table, &hit.attributes[kHitPositionTable], sizeof(table));
  }
  return table;
}

// The ID of the hit's cluster; kNoCluster: it is in none.
KAAMOS_INLINE uint32_t cluster_id(uint2 table) {
  const ClusterTriangle* in_cluster = cluster_triangle(as_number(table));
  return in_cluster != nullptr ? in_cluster->cluster_id : kNoCluster;
}

inline const GeometryPositions* geometry_positions(uint2 table, uint32_t geometry) {
  const uint64_t address = as_number(table);
  if (address == 0) return nullptr;
  const ClusterTriangle* in_cluster = cluster_triangle(address);
  const GeometryPositions* found =
      in_cluster != nullptr ? in_cluster->geometry
                            : reinterpret_cast<const GeometryPositions*>(address) + geometry;
  return found->xyz != nullptr ? found : nullptr;
}

// Row by row, in the order of the build. Zeros if the hit is no triangle.
inline float3x3 triangle_positions(uint2 table, uint32_t geometry, uint32_t primitive) {
  float3x3 result = {};
  const GeometryPositions* positions = geometry_positions(table, geometry);
  if (positions == nullptr) return result;
  if (const ClusterTriangle* in_cluster = cluster_triangle(as_number(table))) {
    primitive = in_cluster->triangle;
  }
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
