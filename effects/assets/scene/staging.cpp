// SPDX-License-Identifier: MIT
#include "effects/assets/scene/staging.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "effects/assets/scene/shapes.h"

namespace kaamos::effects {
namespace {

/// Calls `visit(a, b, c)` with the world-space corners of every triangle.
template <class Visit>
void each_triangle(const Scene& scene, Visit visit) {
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool mirrored = is_mirrored(instance);
    const auto world = [&](const Vertex& vertex) {
      return glm::dvec3(instance.transform * glm::dvec4(glm::dvec3(vertex.position), 1.0));
    };
    for (const Geometry& g : mesh.geometries)
      for (std::uint32_t t = 0; t < g.index_count / 3; ++t)
        visit(world(mesh.corner(g, t, 0)), world(mesh.corner(g, t, mirrored ? 2 : 1)),
              world(mesh.corner(g, t, mirrored ? 1 : 2)));
  }
}

/// A few rays against all triangles. Each scene needs them once, so an acceleration structure would
/// not pay.
struct Probe {
  glm::dvec3 direction;
  double distance = std::numeric_limits<double>::infinity();
  bool front = false;
};

void cast(const Scene& scene, const glm::dvec3& origin, std::vector<Probe>& probes) {
  each_triangle(scene, [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 e1 = b - a, e2 = c - a, s = origin - a, q = glm::cross(s, e1);
    for (Probe& probe : probes) {
      const glm::dvec3 p = glm::cross(probe.direction, e2);
      const double determinant = glm::dot(e1, p);
      if (determinant == 0.0) continue;
      const double u = glm::dot(s, p) / determinant;
      const double v = glm::dot(probe.direction, q) / determinant;
      const double t = glm::dot(e2, q) / determinant;
      if (u < 0.0 || v < 0.0 || u + v > 1.0 || t <= 0.0 || t >= probe.distance) continue;
      probe.distance = t;
      probe.front = determinant > 0.0;
    }
  });
}

/// The 26 directions to the faces, edges and corners of a cube.
std::vector<Probe> cube_probes() {
  std::vector<Probe> probes;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x || y || z) probes.push_back({glm::normalize(glm::dvec3(x, y, z))});
  return probes;
}

Camera interior_camera(const Scene& scene) {
  const Bounds bounds = scene_bounds(scene);
  // A little above the centre, where there is seldom furniture.
  const glm::dvec3 middle = bounds.center() + glm::dvec3(0.0, 0.05 * bounds.size().y, 0.0);
  std::vector<Probe> corners;
  for (const double x : {1.0, -1.0})
    for (const double z : {1.0, -1.0})
      corners.push_back({glm::normalize(bounds.size() * glm::dvec3(x, 0.1, z))});
  cast(scene, middle, corners);
  const Probe& longest =
      *std::max_element(corners.begin(), corners.end(),
                        [](const Probe& a, const Probe& b) { return a.distance < b.distance; });
  const double distance = std::min(longest.distance, glm::length(bounds.size()));
  Camera camera;
  camera.name = "interior";
  camera.vertical_fov = 1.1;
  const glm::dvec3 eye = middle + longest.direction * (0.85 * distance);
  camera.camera_to_world = look_at(eye, bounds.center() - glm::dvec3(0, 0.15 * bounds.size().y, 0));
  camera.near_plane = distance * 1e-3;
  return camera;
}

}  // namespace

Camera framing_camera(const Bounds& bounds) {
  Camera camera;
  camera.name = "framing";
  camera.vertical_fov = 0.75;
  const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : bounds.center();
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.55, 0.42, 1.0));
  // As close as possible with all corners of the bounds in a 16:9 picture, plus 4 %.
  const glm::dmat3 view = glm::transpose(glm::dmat3(look_at(direction, glm::dvec3(0.0))));
  const double slope = std::tan(0.5 * camera.vertical_fov);
  double distance = 1e-6;
  for (int corner = 0; corner < 8 && !bounds.empty(); ++corner) {
    const glm::dvec3 offset =
        0.5 * bounds.size() *
        glm::dvec3((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const glm::dvec3 v = view * offset;
    distance = std::max(
        {distance, v.z + std::abs(v.y) / slope, v.z + std::abs(v.x) / (slope * 16.0 / 9.0)});
  }
  distance *= 1.04;
  camera.camera_to_world = look_at(center + direction * distance, center);
  camera.near_plane = distance * 1e-3;
  return camera;
}

bool is_interior(const Scene& scene) {
  const Bounds bounds = scene_bounds(scene);
  if (bounds.empty() || instanced_triangle_count(scene) > 4'000'000) return false;
  std::vector<Probe> probes = cube_probes();
  cast(scene, bounds.center(), probes);
  int closed = 0, near = 0;
  for (const Probe& probe : probes) {
    const bool hit = probe.front && std::isfinite(probe.distance);
    closed += hit;
    // A hall inside a house is enclosed too, but there the file shows the house. In a room, walls,
    // floor and ceiling are where the scene ends.
    for (int axis = 0; axis < 3; ++axis)
      near += hit && std::abs(probe.direction[axis]) > 0.99 &&
              probe.distance < 0.25 * bounds.size()[axis];
  }
  // One near hit may be an object in the middle of the room.
  return closed >= 22 && near <= 1;
}

Camera default_camera(const Scene& scene) {
  return is_interior(scene) ? interior_camera(scene) : framing_camera(scene_bounds(scene));
}

Sun default_sun() {
  Sun sun;
  sun.direction_to_sun = glm::normalize(glm::vec3(0.45f, 0.8f, 0.55f));
  sun.irradiance = glm::vec3(3.2f, 3.0f, 2.7f);
  return sun;
}

Sky default_sky() {
  Sky sky;
  sky.zenith = glm::vec3(0.22f, 0.38f, 0.75f);
  sky.horizon = glm::vec3(0.75f, 0.82f, 0.92f);
  sky.ground = glm::vec3(0.24f, 0.22f, 0.2f);
  return sky;
}

bool needs_ground(const Scene& scene) {
  const Bounds bounds = scene_bounds(scene);
  if (bounds.empty()) return false;
  const glm::dvec3 size = bounds.size();
  const double limit = bounds.min.y + 0.05 * size.y;
  double covered = 0.0;
  each_triangle(scene, [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    if (std::max({a.y, b.y, c.y}) > limit) return;
    // The upward component of the area vector is the area of the triangle's outline seen from
    // above.
    covered += std::max(0.0, 0.5 * glm::cross(b - a, c - a).y);
  });
  return covered < size.x * size.z / 3.0;
}

void add_ground(Scene& scene) {
  const Bounds bounds = scene_bounds(scene);
  if (bounds.empty()) return;
  Material material;
  material.name = "ground";
  material.constants.base_color = glm::vec4(0.33f, 0.32f, 0.30f, 1.0f);
  const double half = 6.0 * std::max({bounds.size().x, bounds.size().z, 0.2 * bounds.size().y});
  Mesh mesh;
  mesh.name = "ground";
  add_shape(mesh, patch({-half, 0, half}, {2.0 * half, 0, 0}, {0, 0, -2.0 * half}, 1, 1),
            static_cast<std::uint32_t>(scene.materials.size()));
  Instance instance;
  instance.name = "ground";
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  const glm::dvec3 center = bounds.center();
  instance.transform = translate({center.x, bounds.min.y, center.z});
  scene.materials.push_back(material);
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(instance);
}

}  // namespace kaamos::effects
