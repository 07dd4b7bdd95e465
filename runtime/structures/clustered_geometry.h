// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. What a bottom level of clusters is built from: the triangles of all its clusters,
// decoded and put together by geometry index and flags. [DXR 2.0: Clustered geometry]
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>

#include "kaamos/shader/triangle_positions.h"
#include "runtime/structures/opacity_micromap.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

// Triangles with the same geometry index and flags. Several may have the same geometry index.
struct ClusteredGeometry {
  uint32_t geometry_index = 0;  // GeometryIndex: 24 bits, and others may be left out
  rtapi::RaytracingGeometryFlags flags = {};
  std::vector<float> xyz;                    // 3 per vertex, in object space
  std::vector<uint32_t> indices;             // 3 per triangle
  std::vector<uint32_t> primitive_index;     // by triangle: its number in its cluster
  std::vector<uint32_t> cluster_id;          // by triangle
  std::shared_ptr<MicromapLinkage> linkage;  // by triangle; null: no opacity micromaps

  uint32_t triangles() const { return static_cast<uint32_t>(indices.size() / 3); }
};

GeometryShape shape_of(const ClusteredGeometry& geometry);

// What the triangles of a bottom level are to the application, by the backend's numbers of geometry
// and triangle.
class ClusterTriangles {
 public:
  void set(std::span<const ClusteredGeometry> geometries);
  bool empty() const { return triangles_.empty(); }
  const shader::ClusterTriangle* of(uint32_t geometry) const {
    return geometry < triangles_.size() ? triangles_[geometry].data() : nullptr;
  }
  // Where their positions are; one for each geometry, and it must stay where it is.
  void refer_to(std::span<const shader::GeometryPositions> positions);

 private:
  std::vector<std::vector<shader::ClusterTriangle>> triangles_;
};

}  // namespace kaamos::runtime
