// SPDX-License-Identifier: MIT
#include "tests/shaders/gltf_geometry.h"

#include <cstring>

#include "effects/assets/gltf/gltf_load.h"

namespace kaamos::shader_tests {
namespace {

uint32_t index_at(const effects::Mesh& mesh, const effects::Geometry& geometry, uint32_t i) {
  const uint8_t* bytes =
      mesh.indices.data() + geometry.index_offset_bytes + size_t{i} * geometry.index_size_bytes;
  uint32_t index = 0;
  std::memcpy(&index, bytes, geometry.index_size_bytes);
  return geometry.first_vertex + index;
}

}  // namespace

std::string read_gltf(const std::string& path, const std::string& bottom_level,
                      std::vector<SceneGeometry>& out) {
  const auto loaded = effects::load_gltf(path);
  if (!loaded.ok()) return loaded.error().message;
  for (const effects::Instance& instance : loaded->scene.instances) {
    const effects::Mesh& mesh = loaded->scene.meshes[instance.mesh];
    for (const effects::Geometry& geometry : mesh.geometries) {
      SceneGeometry made;
      made.bottom_level = bottom_level;
      if (!geometry.alpha_tested) made.flags = rtapi::RaytracingGeometryFlags::kOpaque;
      made.points.reserve(size_t{geometry.index_count} * 3);
      for (uint32_t i = 0; i < geometry.index_count; ++i) {
        const glm::vec3 at = mesh.vertices[index_at(mesh, geometry, i)].position;
        const glm::dvec3 placed(instance.transform * glm::dvec4(at, 1));
        for (int axis = 0; axis < 3; ++axis) {
          made.points.push_back(static_cast<float>(placed[axis]));
        }
      }
      out.push_back(std::move(made));
    }
  }
  return {};
}

}  // namespace kaamos::shader_tests
