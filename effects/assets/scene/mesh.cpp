// SPDX-License-Identifier: MIT
#include "effects/assets/scene/mesh.h"

#include <cassert>
#include <cmath>
#include <cstring>

namespace kaamos::effects {

void Bounds::add(const glm::dvec3& point) {
  min = glm::min(min, point);
  max = glm::max(max, point);
}

void Mesh::add_geometry(std::span<const Vertex> piece, std::span<const std::uint32_t> piece_indices,
                        std::uint32_t material, bool alpha_tested) {
  assert(piece_indices.size() % 3 == 0);
  Geometry geometry;
  geometry.first_vertex = static_cast<std::uint32_t>(vertices.size());
  geometry.vertex_count = static_cast<std::uint32_t>(piece.size());
  indices.resize((indices.size() + 15) / 16 * 16, 0);
  geometry.index_offset_bytes = static_cast<std::uint32_t>(indices.size());
  geometry.index_count = static_cast<std::uint32_t>(piece_indices.size());
  geometry.index_size_bytes = piece.size() <= 65536 ? 2 : 4;
  geometry.material = material;
  geometry.alpha_tested = alpha_tested;
  vertices.insert(vertices.end(), piece.begin(), piece.end());
  const std::size_t bytes = std::size_t{geometry.index_size_bytes} * piece_indices.size();
  indices.resize(indices.size() + (bytes + 3) / 4 * 4, 0);
  std::uint8_t* out = indices.data() + geometry.index_offset_bytes;
  for (const std::uint32_t i : piece_indices) {
    assert(i < piece.size());
    std::memcpy(out, &i, geometry.index_size_bytes);
    out += geometry.index_size_bytes;
  }
  geometries.push_back(geometry);
}

void Mesh::add_colors(std::span<const VertexColor> of_last) {
  if (of_last.empty() && colors.empty()) return;
  const std::uint32_t first = geometries.back().first_vertex;
  assert(of_last.empty() || of_last.size() == geometries.back().vertex_count);
  colors.resize(first, kWhite);
  colors.insert(colors.end(), of_last.begin(), of_last.end());
  colors.resize(vertices.size(), kWhite);
}

void Mesh::add_second_uv(std::span<const glm::vec2> of_last) {
  if (of_last.empty() && second_uv.empty()) return;
  for (std::size_t i = second_uv.size(); i < geometries.back().first_vertex; ++i)
    second_uv.push_back(vertices[i].uv);
  second_uv.insert(second_uv.end(), of_last.begin(), of_last.end());
  for (std::size_t i = second_uv.size(); i < vertices.size(); ++i)
    second_uv.push_back(vertices[i].uv);
}

Mesh::More Mesh::more(std::size_t i) const {
  return {colors.empty() ? kWhite : colors[i], second_uv.empty() ? vertices[i].uv : second_uv[i]};
}

std::uint32_t Mesh::index(const Geometry& geometry, std::uint32_t i) const {
  std::uint32_t value = 0;
  std::memcpy(
      &value,
      indices.data() + geometry.index_offset_bytes + std::size_t{i} * geometry.index_size_bytes,
      geometry.index_size_bytes);
  return value;
}

const Vertex& Mesh::corner(const Geometry& geometry, std::uint32_t triangle,
                           std::uint32_t corner) const {
  return vertices[geometry.first_vertex + index(geometry, 3 * triangle + corner)];
}

std::uint64_t Mesh::triangle_count() const {
  std::uint64_t count = 0;
  for (const Geometry& geometry : geometries) count += geometry.index_count / 3;
  return count;
}

Bounds Mesh::bounds() const {
  Bounds box;
  for (const Vertex& vertex : vertices) {
    const glm::vec3& p = vertex.position;
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) box.add(p);
  }
  return box;
}

}  // namespace kaamos::effects
