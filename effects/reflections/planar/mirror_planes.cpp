// SPDX-License-Identifier: MIT
// Finds the flat mirrors of a scene.
#include <algorithm>
#include <cmath>
#include <optional>

#include "effects/reflections/planar/planar_reflections.h"

namespace kaamos::effects {

namespace {

constexpr float kMirrorRoughness = 0.03f;  // [effects/shaders/brdf.hlsli]
constexpr double kFlat = 1e-5;       // of a mesh's size: how far off its plane a vertex may be
constexpr double kSamePlane = 1e-4;  // of the larger plane's width, and of the normal

bool is_mirror(const Scene& scene, const Mesh& mesh) {
  return !mesh.geometries.empty() &&
         std::all_of(mesh.geometries.begin(), mesh.geometries.end(), [&](const Geometry& geometry) {
           const MaterialConstants& material = scene.materials[geometry.material].constants;
           return material.roughness <= kMirrorRoughness && material.base_color.a >= 1 &&
                  (material.flags & kMaterialUnlit) == 0;
         });
}

// The plane that all triangles of an instance lie in; none: they do not.
std::optional<MirrorPlane> plane_of(const Mesh& mesh, const glm::dmat4& transform) {
  std::optional<MirrorPlane> plane;
  double size = 0;
  for (const Geometry& geometry : mesh.geometries) {
    const std::uint32_t triangles = geometry.index_count / 3;
    for (std::uint32_t i = 0; i < triangles; ++i) {
      glm::dvec3 p[3];
      for (std::uint32_t k = 0; k < 3; ++k) {
        const glm::vec3 position = mesh.corner(geometry, i, k).position;
        p[k] = glm::dvec3(transform * glm::dvec4(position, 1));
      }
      const glm::dvec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
      const double twice_area = glm::length(across);
      if (!(twice_area > 0)) continue;
      if (!plane) plane = MirrorPlane{p[0], across / twice_area, 0};
      plane->area += 0.5 * twice_area;
      for (const glm::dvec3& each : p) {
        size = std::max(size, glm::distance(each, plane->point));
        if (std::abs(glm::dot(each - plane->point, plane->normal)) > kFlat * size) return {};
      }
    }
  }
  return plane;
}

bool is_same(const MirrorPlane& a, const MirrorPlane& b) {
  return std::abs(glm::dot(a.normal, b.normal)) > 1 - kSamePlane &&
         std::abs(glm::dot(b.point - a.point, a.normal)) <
             kSamePlane * std::sqrt(std::max(a.area, b.area));
}

}  // namespace

std::vector<MirrorPlane> find_mirror_planes(const Scene& scene) {
  std::vector<MirrorPlane> planes;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if ((instance.mask & kMaskOpaque) == 0 || !is_mirror(scene, mesh)) continue;
    const auto plane = plane_of(mesh, instance.transform);
    if (!plane) continue;
    const auto same = std::find_if(planes.begin(), planes.end(),
                                   [&](const MirrorPlane& each) { return is_same(each, *plane); });
    if (same == planes.end()) {
      planes.push_back(*plane);
    } else {
      same->area += plane->area;
    }
  }
  std::stable_sort(planes.begin(), planes.end(),
                   [](const MirrorPlane& a, const MirrorPlane& b) { return a.area > b.area; });
  if (planes.size() > kMostMirrorPlanes) planes.resize(kMostMirrorPlanes);
  return planes;
}

}  // namespace kaamos::effects
