// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Clusters of triangles, of which bottom levels consist, and templates of them, as
// operations decode them from GPU memory. [DXR 2.0: Cluster level acceleration structure]
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <rtapi/rtas_operations.h>

#include "runtime/structures/opacity_micromap.h"

namespace kaamos::runtime {

struct Cluster {
  uint32_t id = 0;
  bool data_access = false;  // shaders may read positions
  bool allows_disable_omms = false;
  std::vector<float> xyz;         // 3 per vertex; NaN: its triangles are never hit
  std::vector<uint16_t> indices;  // 3 per triangle
  // By triangle: GeometryIndex in the low 24 bits, and flags above.
  std::vector<uint32_t> geometry;
  std::shared_ptr<MicromapLinkage> linkage;  // by triangle; null: no opacity micromaps

  uint32_t triangles() const { return static_cast<uint32_t>(geometry.size()); }
};

// A cluster without positions, and how those of its instances are stored.
struct ClusterTemplate {
  Cluster cluster;
  uint32_t vertices = 0;
  rtapi::RtasVertexFormat format = rtapi::RtasVertexFormat::kFloat32x3;
  uint32_t compressed_header = 0;  // kCompressed1
  uint32_t truncated_bits = 0;     // the others
  bool bounded = false;            // vertices should be in the box
  float lower[3] = {0, 0, 0};
  float upper[3] = {0, 0, 0};
};

}  // namespace kaamos::runtime
