// SPDX-License-Identifier: MIT
// Finds the flat surfaces of a scene that mirror.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "effects/reflections/planar/planar_reflections.h"

namespace kaamos::effects {

namespace {

constexpr double kMirrorRoughness = 0.03;  // [effects/shaders/brdf.hlsli: IsMirror]
constexpr double kSamePlane = 1e-4;        // of the larger plane's width, and of the normal
constexpr double kNormalCell = 1e-3;       // triangles of about one normal
constexpr double kPlaceCell = 1e-4;  // and, in parts of the scene's size, one place are one plane
// Planes are at least so large, in parts of the square of the scene's size.
constexpr double kLeastArea = 1e-3;
constexpr std::size_t kMostGroups = 256;  // that are compared with each other

// Triangles in one plane.
struct Group {
  MirrorPlane plane;   // of the largest of them, relative to the first camera
  double largest = 0;  // its area
  double weight = 0;   // sum of area times smoothness squared
};

using Key = std::array<long long, 4>;

// 1 for a mirror, 0 for what is no plane's.
double smoothness(const Scene& scene, std::uint32_t id, double roughest) {
  const MaterialConstants& material = scene.materials[id].constants;
  if (!(material.base_color.a >= 1) || (material.flags & kMaterialUnlit) != 0) return 0;
  double roughness = material.roughness;
  const std::uint32_t image = material.image[kMetallicRoughnessTexture];
  if (image < scene.images.size() && !scene.images[image].mips.empty()) {
    // The last level is the mean.
    const std::vector<std::uint8_t>& mean = scene.images[image].mips.back();
    if (mean.size() >= 4) roughness *= mean[1] / 255.0;
  }
  return roughness <= roughest ? 1 - std::max(roughness, 0.0) : 0;
}

// An order of planes that does not depend on that of the scene's parts.
auto place_of(const MirrorPlane& plane) {
  const glm::dvec3& n = plane.normal;
  return std::tuple(glm::dot(plane.point, n), n.x, n.y, n.z);
}

void add_triangle(std::map<Key, Group>& groups, const std::array<glm::dvec3, 3>& p, double smooth,
                  double size) {
  const glm::dvec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double length = glm::length(across);
  if (!(length > 0) || !std::isfinite(length)) return;
  glm::dvec3 normal = across / length;
  int main_axis = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(normal[axis]) > std::abs(normal[main_axis]) + kNormalCell) main_axis = axis;
  }
  if (normal[main_axis] < 0) normal = -normal;
  const double place = glm::dot(p[0], normal);
  const Key key = {std::llround(normal.x / kNormalCell), std::llround(normal.y / kNormalCell),
                   std::llround(normal.z / kNormalCell), std::llround(place / (kPlaceCell * size))};
  Group& group = groups[key];
  const double area = 0.5 * length;
  const MirrorPlane plane{p[0], normal, 0};
  const bool is_first = group.largest == area && place_of(plane) < place_of(group.plane);
  if (area > group.largest || is_first) {
    group.plane.point = plane.point;
    group.plane.normal = plane.normal;
    group.largest = area;
  }
  group.plane.area += area;
  group.plane.is_mirror = group.plane.is_mirror && smooth >= 1 - kMirrorRoughness;
  group.weight += area * smooth * smooth;
}

bool is_same(const MirrorPlane& a, const MirrorPlane& b) {
  return std::abs(glm::dot(a.normal, b.normal)) > 1 - kSamePlane &&
         std::abs(glm::dot(b.point - a.point, a.normal)) <
             kSamePlane * std::sqrt(std::max(a.area, b.area));
}

// The weightiest first. Sums in another order differ by rounding, which is not to decide.
void sort(std::vector<Group>& groups) {
  std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    const auto x = static_cast<float>(a.weight), y = static_cast<float>(b.weight);
    return x != y ? x > y : place_of(a.plane) < place_of(b.plane);
  });
}

// Groups of one plane whose cells are neighbours.
std::vector<Group> joined(std::vector<Group> groups) {
  sort(groups);
  if (groups.size() > kMostGroups) groups.resize(kMostGroups);
  std::vector<Group> out;
  for (const Group& group : groups) {
    const auto same = std::find_if(out.begin(), out.end(), [&](const Group& each) {
      return is_same(each.plane, group.plane);
    });
    if (same == out.end()) {
      out.push_back(group);
    } else {
      same->plane.area += group.plane.area;
      same->weight += group.weight;
      same->plane.is_mirror = same->plane.is_mirror && group.plane.is_mirror;
    }
  }
  return out;
}

std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, const Geometry& geometry,
                                     std::uint32_t triangle, const glm::mat3x4& rows) {
  std::array<glm::dvec3, 3> out;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const glm::dvec4 position(glm::dvec3(mesh.corner(geometry, triangle, k).position), 1);
    for (int axis = 0; axis < 3; ++axis) {
      out[k][axis] = glm::dot(glm::dvec4(rows[axis]), position);
    }
  }
  return out;
}

}  // namespace

std::vector<MirrorPlane> find_mirror_planes(const Scene& scene, const PlanarConstants& constants) {
  const double size = glm::length(scene_bounds(scene).size());
  if (!(size > 0) || !std::isfinite(size)) return {};
  const glm::dvec3 camera = scene.cameras.front().position();
  std::map<Key, Group> found;
  for (const Instance& instance : scene.instances) {
    if ((instance.mask & kMaskOpaque) == 0) continue;
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::mat3x4 rows = transform_3x4(instance, camera);
    for (const Geometry& geometry : mesh.geometries) {
      const double smooth = smoothness(scene, geometry.material, constants.roughest);
      if (!(smooth > 0)) continue;
      for (std::uint32_t i = 0; i < geometry.index_count / 3; ++i) {
        add_triangle(found, corners_of(mesh, geometry, i, rows), smooth, size);
      }
    }
  }
  std::vector<Group> groups;
  groups.reserve(found.size());
  for (const auto& [key, group] : found) groups.push_back(group);
  groups = joined(std::move(groups));
  sort(groups);
  std::vector<MirrorPlane> planes;
  for (Group& group : groups) {
    if (planes.size() == constants.most_planes) break;
    if (group.plane.area < kLeastArea * size * size) continue;
    group.plane.point += camera;
    planes.push_back(group.plane);
  }
  return planes;
}

}  // namespace kaamos::effects
