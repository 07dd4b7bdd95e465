// SPDX-License-Identifier: MIT
#include "runtime/structures/clustered_geometry.h"

namespace kaamos::runtime {

GeometryShape shape_of(const ClusteredGeometry& geometry) {
  using rtapi::RaytracingGeometryFlags;
  GeometryShape shape;
  shape.vertex_format = rtapi::Format::kR32G32B32Float;
  shape.index_format = rtapi::Format::kR32Uint;
  shape.index = geometry.geometry_index;
  shape.opaque = rtapi::HasAny(geometry.flags, RaytracingGeometryFlags::kOpaque);
  shape.no_duplicate_any_hit =
      rtapi::HasAny(geometry.flags, RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation);
  shape.linked = geometry.linkage != nullptr;
  shape.vertices = static_cast<uint32_t>(geometry.xyz.size() / 3);
  shape.primitives = geometry.triangles();
  return shape;
}

void ClusterTriangles::set(std::span<const ClusteredGeometry> geometries) {
  triangles_.clear();
  for (const ClusteredGeometry& geometry : geometries) {
    auto& triangles = triangles_.emplace_back(geometry.triangles());
    for (uint32_t i = 0; i < geometry.triangles(); ++i) {
      triangles[i] = {nullptr, i, geometry.geometry_index, geometry.primitive_index[i],
                      geometry.cluster_id[i]};
    }
  }
}

void ClusterTriangles::refer_to(std::span<const shader::GeometryPositions> positions) {
  for (size_t g = 0; g < triangles_.size(); ++g) {
    for (shader::ClusterTriangle& triangle : triangles_[g]) triangle.geometry = &positions[g];
  }
}

}  // namespace kaamos::runtime
