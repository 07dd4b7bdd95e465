// SPDX-License-Identifier: MIT
#include "effects/assets/scene/pieces.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace kaamos::effects {
namespace {

struct Triangle {
  std::uint32_t geometry;
  std::uint32_t index;
  glm::vec3 centre;
  float size;  // longest side of its bounds
};

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> out;
  for (std::uint32_t g = 0; g < mesh.geometries.size(); ++g) {
    const Geometry& geometry = mesh.geometries[g];
    for (std::uint32_t t = 0; t < geometry.index_count / 3; ++t) {
      const glm::vec3& a = mesh.corner(geometry, t, 0).position;
      const glm::vec3& b = mesh.corner(geometry, t, 1).position;
      const glm::vec3& c = mesh.corner(geometry, t, 2).position;
      const glm::vec3 size = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
      out.push_back({g, t, (a + b + c) / 3.0f, std::max(size.x, std::max(size.y, size.z))});
    }
  }
  return out;
}

// A large triangle would enlarge the bounds of a piece of small ones, so large ones are kept apart.
constexpr double kLargePart = 1.0 / 8;  // of the mesh's longest side

// Splits into parts of at most `most` triangles, and appends where each part ends.
void split(std::vector<Triangle>& triangles, double mesh_size, std::uint32_t most,
           std::vector<std::size_t>& ends) {
  const auto large = std::partition(
      triangles.begin(), triangles.end(),
      [&](const Triangle& triangle) { return triangle.size <= kLargePart * mesh_size; });
  const auto small_count = static_cast<std::size_t>(large - triangles.begin());
  std::vector<std::pair<std::size_t, std::size_t>> open = {{small_count, triangles.size()},
                                                           {0, small_count}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    if (end - begin <= most) {
      if (begin != end) ends.push_back(end);
      continue;
    }
    Bounds box;
    for (std::size_t i = begin; i < end; ++i) {
      const glm::dvec3 centre(triangles[i].centre);
      if (glm::all(glm::lessThan(glm::abs(centre), glm::dvec3(1e30)))) box.add(centre);
    }
    const glm::dvec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    // Equal centres are ordered by number, so that any standard library makes the same pieces; NaN
    // centres go last.
    const auto before = [axis](const Triangle& a, const Triangle& b) {
      const bool a_lost = !(a.centre[axis] == a.centre[axis]);
      const bool b_lost = !(b.centre[axis] == b.centre[axis]);
      if (a_lost != b_lost) return b_lost;
      if (!a_lost && a.centre[axis] != b.centre[axis]) return a.centre[axis] < b.centre[axis];
      return std::pair(a.geometry, a.index) < std::pair(b.geometry, b.index);
    };
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) {
      return triangles.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(begin), at(middle), at(end), before);
    open.push_back({middle, end});
    open.push_back({begin, middle});
  }
}

Mesh make_piece(const Mesh& mesh, std::vector<Triangle> part, std::size_t number) {
  // Keep the mesh's order, so that what was close in memory stays close.
  std::sort(part.begin(), part.end(), [](const Triangle& a, const Triangle& b) {
    return std::pair(a.geometry, a.index) < std::pair(b.geometry, b.index);
  });
  Mesh piece;
  piece.name = mesh.name + " piece " + std::to_string(number);
  for (std::size_t i = 0; i < part.size();) {
    const std::uint32_t id = part[i].geometry;
    const Geometry& geometry = mesh.geometries[id];
    std::vector<Vertex> vertices;
    std::vector<VertexColor> colors;
    std::vector<glm::vec2> second_uv;
    std::vector<std::uint32_t> indices;
    std::unordered_map<std::uint32_t, std::uint32_t> place;  // from a vertex of the mesh
    for (; i < part.size() && part[i].geometry == id; ++i) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t from = mesh.index(geometry, 3 * part[i].index + c);
        const auto [found, is_new] =
            place.try_emplace(from, static_cast<std::uint32_t>(vertices.size()));
        if (is_new) vertices.push_back(mesh.vertices[geometry.first_vertex + from]);
        if (is_new && !mesh.colors.empty())
          colors.push_back(mesh.colors[geometry.first_vertex + from]);
        if (is_new && !mesh.second_uv.empty())
          second_uv.push_back(mesh.second_uv[geometry.first_vertex + from]);
        indices.push_back(found->second);
      }
    }
    piece.add_geometry(vertices, indices, geometry.material, geometry.alpha_tested);
    piece.add_colors(colors);
    piece.add_second_uv(second_uv);
  }
  return piece;
}

// Marks the meshes that must not be split.
std::vector<bool> whole_meshes(const Scene& scene) {
  std::vector<bool> whole(scene.meshes.size(), false);
  for (const Instance& instance : scene.instances) {
    if (instance.motion.skin != kNoIndex || instance.motion.morph != kNoIndex)
      whole[instance.mesh] = true;
    for (const Level& level : instance.levels) whole[level.mesh] = true;
  }
  return whole;
}

}  // namespace

std::size_t split_into_pieces(Scene& scene, std::uint32_t most_triangles) {
  const std::vector<bool> whole = whole_meshes(scene);
  std::vector<Mesh> meshes;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pieces;  // first and count, by old mesh
  std::size_t count = 0;
  for (std::size_t id = 0; id < scene.meshes.size(); ++id) {
    Mesh& mesh = scene.meshes[id];
    const auto first = static_cast<std::uint32_t>(meshes.size());
    if (whole[id] || mesh.triangle_count() <= most_triangles) {
      meshes.push_back(std::move(mesh));
    } else {
      std::vector<Triangle> triangles = triangles_of(mesh);
      std::vector<std::size_t> ends;
      const glm::dvec3 size = mesh.bounds().size();
      split(triangles, std::max(size.x, std::max(size.y, size.z)), std::max(most_triangles, 1u),
            ends);
      std::size_t begin = 0;
      for (const std::size_t end : ends) {
        const auto at = [&](std::size_t i) {
          return triangles.begin() + static_cast<std::ptrdiff_t>(i);
        };
        meshes.push_back(make_piece(mesh, {at(begin), at(end)}, meshes.size() - first));
        begin = end;
      }
      ++count;
    }
    pieces.push_back({first, static_cast<std::uint32_t>(meshes.size()) - first});
  }
  std::vector<Instance> instances;
  for (const Instance& instance : scene.instances) {
    const auto [first, number] = pieces[instance.mesh];
    for (std::uint32_t i = 0; i < number; ++i) {
      Instance piece = instance;
      piece.mesh = first + i;
      for (Level& level : piece.levels) level.mesh = pieces[level.mesh].first;
      instances.push_back(std::move(piece));
    }
  }
  scene.meshes = std::move(meshes);
  scene.instances = std::move(instances);
  return count;
}

}  // namespace kaamos::effects
