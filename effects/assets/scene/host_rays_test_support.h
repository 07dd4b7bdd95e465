// SPDX-License-Identifier: MIT
/// @file
/// Rays on the host through every triangle of a small scene, in double: what formulas are held
/// against.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The point where a ray meets a scene.
struct HostHit {
  double t = 0.0;                ///< in lengths of the direction
  std::uint32_t instance = 0;    ///< in Scene::instances
  std::uint32_t geometry = 0;    ///< of its mesh
  std::uint32_t triangle = 0;    ///< of the geometry
  glm::dvec2 barycentrics{0.0};  ///< of the second and third corner
};

/// The triangles of a scene at time 0.
class HostRays {
 public:
  explicit HostRays(const Scene& scene) {
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
      const Instance& instance = scene.instances[i];
      const Mesh& mesh = scene.meshes[instance.mesh];
      for (std::uint32_t g = 0; g < mesh.geometries.size(); ++g) {
        const Geometry& geometry = mesh.geometries[g];
        for (std::uint32_t t = 0; t < geometry.index_count / 3; ++t) {
          Triangle triangle{{}, i, g, t};
          for (std::uint32_t c = 0; c < 3; ++c) {
            const glm::dvec3 p(mesh.corner(geometry, t, c).position);
            triangle.corners[c] = glm::dvec3(instance.transform * glm::dvec4(p, 1.0));
          }
          triangles_.push_back(triangle);
        }
      }
    }
  }

  /// The nearest hit beyond 1e-9 that `takes` accepts.
  template <class Takes>
  std::optional<HostHit> nearest(const glm::dvec3& from, const glm::dvec3& way,
                                 const Takes& takes) const {
    std::optional<HostHit> best;
    for (const Triangle& triangle : triangles_) {
      // [Moller & Trumbore 1997]
      const glm::dvec3 a = triangle.corners[1] - triangle.corners[0];
      const glm::dvec3 b = triangle.corners[2] - triangle.corners[0];
      const glm::dvec3 p = glm::cross(way, b), s = from - triangle.corners[0];
      const double determinant = glm::dot(a, p);
      if (determinant == 0.0) continue;
      const glm::dvec3 q = glm::cross(s, a);
      const double u = glm::dot(s, p) / determinant, v = glm::dot(way, q) / determinant;
      const double t = glm::dot(b, q) / determinant;
      if (u < 0 || v < 0 || u + v > 1 || t <= 1e-9 || (best && t >= best->t)) continue;
      const HostHit hit{t, triangle.instance, triangle.geometry, triangle.index, {u, v}};
      if (takes(hit)) best = hit;
    }
    return best;
  }
  /// The nearest hit of all.
  std::optional<HostHit> nearest(const glm::dvec3& from, const glm::dvec3& way) const {
    return nearest(from, way, [](const HostHit&) { return true; });
  }

 private:
  struct Triangle {
    glm::dvec3 corners[3];
    std::uint32_t instance, geometry, index;
  };
  std::vector<Triangle> triangles_;
};

}  // namespace kaamos::effects
