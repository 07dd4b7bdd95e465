// SPDX-License-Identifier: MIT
#include "effects/assets/scene/tangents.h"

#include <cmath>

namespace kaamos::effects {
namespace {

/// Cross product in double, because float loses small triangles far from the origin.
glm::dvec3 area_normal(const Vertex& a, const Vertex& b, const Vertex& c) {
  const glm::dvec3 origin(a.position);
  return glm::cross(glm::dvec3(b.position) - origin, glm::dvec3(c.position) - origin);
}

glm::vec3 unit_or(const glm::dvec3& v, const glm::vec3& fallback) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : fallback;
}

}  // namespace

glm::vec3 any_perpendicular(const glm::vec3& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

void make_flat_normals(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices) {
  std::vector<Vertex> flat;
  flat.reserve(indices.size());
  for (const std::uint32_t index : indices) flat.push_back(vertices[index]);
  for (std::size_t i = 0; i + 2 < flat.size(); i += 3) {
    const glm::vec3 normal =
        unit_or(area_normal(flat[i], flat[i + 1], flat[i + 2]), glm::vec3(0, 1, 0));
    for (std::size_t k = 0; k < 3; ++k) flat[i + k].normal = normal;
  }
  vertices = std::move(flat);
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
}

void make_smooth_normals(std::span<Vertex> vertices, std::span<const std::uint32_t> indices) {
  std::vector<glm::dvec3> sums(vertices.size(), glm::dvec3(0.0));
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const glm::dvec3 n =
        area_normal(vertices[indices[i]], vertices[indices[i + 1]], vertices[indices[i + 2]]);
    for (std::size_t k = 0; k < 3; ++k) sums[indices[i + k]] += n;
  }
  for (std::size_t v = 0; v < vertices.size(); ++v)
    vertices[v].normal = unit_or(sums[v], glm::vec3(0, 1, 0));
}

void make_tangents(std::span<Vertex> vertices, std::span<const std::uint32_t> indices) {
  std::vector<glm::dvec3> along_u(vertices.size(), glm::dvec3(0.0));
  std::vector<double> handedness(vertices.size(), 0.0);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Vertex& a = vertices[indices[i]];
    const Vertex& b = vertices[indices[i + 1]];
    const Vertex& c = vertices[indices[i + 2]];
    const glm::dvec3 e1 = glm::dvec3(b.position) - glm::dvec3(a.position);
    const glm::dvec3 e2 = glm::dvec3(c.position) - glm::dvec3(a.position);
    const glm::dvec2 d1 = glm::dvec2(b.uv) - glm::dvec2(a.uv);
    const glm::dvec2 d2 = glm::dvec2(c.uv) - glm::dvec2(a.uv);
    const double area = d1.x * d2.y - d2.x * d1.y;
    if (area == 0.0 || !std::isfinite(area)) continue;
    const double sign = area > 0.0 ? 1.0 : -1.0;
    // Not divided by the uv area, so that a triangle is weighted by its size in both spaces and
    // tiny uv areas do not blow up.
    const glm::dvec3 tangent = (e1 * d2.y - e2 * d1.y) * sign;
    for (std::size_t k = 0; k < 3; ++k) {
      along_u[indices[i + k]] += tangent;
      // v grows downwards in the picture but the bitangent points up, hence the minus.
      handedness[indices[i + k]] -= sign * glm::length(tangent);
    }
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const glm::dvec3 n(vertices[v].normal);
    const glm::dvec3 t = along_u[v] - n * glm::dot(n, along_u[v]);
    const bool usable = glm::dot(t, t) > 1e-12 * glm::dot(along_u[v], along_u[v]);
    vertices[v].tangent = glm::vec4(usable ? unit_or(t, any_perpendicular(vertices[v].normal))
                                           : any_perpendicular(vertices[v].normal),
                                    handedness[v] < 0.0 ? -1.0f : 1.0f);
  }
}

}  // namespace kaamos::effects
