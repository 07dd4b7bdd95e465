// SPDX-License-Identifier: MIT
// Reads the meshes of a glTF file: one mesh with one geometry per primitive.
#include <algorithm>
#include <cmath>

#include "effects/assets/gltf/gltf_accessor.h"
#include "effects/assets/gltf/gltf_piece.h"
#include "effects/assets/scene/tangents.h"

namespace kaamos::effects {
namespace {

/// Converts a list, strip or fan to the indices of a triangle list. [glTF 2.0: primitive.mode]
std::vector<std::uint32_t> as_list(const std::vector<std::uint32_t>& in, int mode) {
  std::vector<std::uint32_t> out;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    out.assign(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(in.size() / 3 * 3));
    return out;
  }
  for (std::size_t i = 0; i + 2 < in.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      // Every second triangle of a strip is reversed, so its last two corners are swapped.
      out.insert(out.end(), {in[i], in[i + 1 + i % 2], in[i + 2 - i % 2]});
    } else {
      out.insert(out.end(), {in[i + 1], in[i + 2], in[0]});
    }
  }
  return out;
}

Status read_triangles(const GltfReader& reader, const tinygltf::Primitive& primitive,
                      const std::string& where, GltfPiece& piece) {
  std::vector<std::uint32_t> raw;
  if (primitive.indices >= 0) {
    Result<std::vector<std::uint32_t>> read =
        read_indices(reader.model, primitive.indices, where + ", indices");
    if (!read.ok()) return read.error();
    raw = std::move(read.value());
    for (std::size_t i = 0; i < raw.size(); ++i)
      if (raw[i] >= piece.vertices.size())
        return make_error(ErrorId::kGltf, where + ", indices: element " + std::to_string(i) +
                                              " is " + std::to_string(raw[i]) +
                                              ", the primitive has " +
                                              std::to_string(piece.vertices.size()) + " vertices");
  } else {
    raw.resize(piece.vertices.size());
    for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = static_cast<std::uint32_t>(i);
  }
  piece.indices = as_list(raw, primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode);
  return {};
}

Status read_material_id(const GltfReader& reader, const tinygltf::Primitive& primitive,
                        const std::string& where, GltfPiece& piece) {
  // The default material comes after the file's materials.
  const std::size_t count = reader.model.materials.size();
  if (primitive.material >= 0 && static_cast<std::size_t>(primitive.material) >= count)
    return make_error(ErrorId::kGltf, where + ": names material " +
                                          std::to_string(primitive.material) + " of " +
                                          std::to_string(count));
  piece.material = primitive.material < 0 ? static_cast<std::uint32_t>(count)
                                          : static_cast<std::uint32_t>(primitive.material);
  return {};
}

/// Repeats values as make_flat_normals repeats the vertices.
template <class T>
void duplicate(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
  if (values.empty()) return;
  std::vector<T> out;
  out.reserve(indices.size());
  for (const std::uint32_t i : indices) out.push_back(values[i]);
  values = std::move(out);
}

/// Triangles without normals get that of their plane, and moves of it that turn it into the plane's
/// normal where one target has all the weight.
void move_flat_normals(GltfPiece& piece) {
  const std::size_t targets = piece.morph_targets;
  const auto corner = [&](std::size_t vertex, std::size_t target) {
    return piece.vertices[vertex].position + piece.morph[vertex * targets + target].position;
  };
  for (std::size_t first = 0; first + 2 < piece.vertices.size(); first += 3) {
    for (std::size_t t = 0; t < targets; ++t) {
      const glm::vec3 a = corner(first, t);
      glm::vec3 normal = glm::cross(corner(first + 1, t) - a, corner(first + 2, t) - a);
      if (!make_unit(normal)) continue;
      for (std::size_t i = first; i < first + 3; ++i)
        piece.morph[i * targets + t].normal = normal - piece.vertices[i].normal;
    }
  }
}

void finish(const Scene& scene, GltfPiece& piece, Mesh& mesh) {
  if (!piece.has_normals) {
    std::vector<MorphMove> moves;
    for (const std::uint32_t i : piece.indices) {
      const auto from = piece.morph.begin() + static_cast<std::ptrdiff_t>(i * piece.morph_targets);
      moves.insert(moves.end(), from, from + piece.morph_targets);
    }
    piece.morph = std::move(moves);
    duplicate(piece.skin, piece.indices);
    duplicate(piece.colors, piece.indices);
    duplicate(piece.second_uv, piece.indices);
    make_flat_normals(piece.vertices, piece.indices);
    move_flat_normals(piece);
    piece.has_tangents = false;
  }
  if (!piece.has_tangents) make_tangents(piece.vertices, piece.indices);
  const bool alpha_tested =
      (scene.materials[piece.material].constants.flags & kMaterialAlphaTested) != 0;
  mesh.morph.insert(mesh.morph.end(), piece.morph.begin(), piece.morph.end());
  mesh.skin.insert(mesh.skin.end(), piece.skin.begin(), piece.skin.end());
  mesh.add_geometry(piece.vertices, piece.indices, piece.material, alpha_tested);
  mesh.add_colors(piece.colors);
  mesh.add_second_uv(piece.second_uv);
}

bool is_triangles(int mode) {
  return mode < 0 || mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

/// `joints`: of the pose to stand in; none: the bind pose. `morph_targets`: to keep.
Result<Mesh> read_mesh(GltfReader& reader, std::size_t id, std::span<const double> weights,
                       const std::vector<glm::dmat4>* joints, std::uint32_t morph_targets = 0) {
  const tinygltf::Mesh& from = reader.model.meshes[id];
  const std::string mesh_where = gltf_part("mesh", id, from.name);
  Mesh mesh;
  mesh.morph_targets = morph_targets;
  mesh.name = from.name.empty() ? "mesh " + std::to_string(id) : from.name;
  for (std::size_t i = 0; i < from.primitives.size(); ++i) {
    const tinygltf::Primitive& primitive = from.primitives[i];
    const std::string where = mesh_where + ", primitive " + std::to_string(i);
    if (!is_triangles(primitive.mode)) {
      reader.warn_once(where + ": is made of points or lines and is left out");
      reader.has_points_or_lines = true;
      continue;
    }
    if (gltf_attribute(primitive, "POSITION") < 0) {
      reader.warn_once(where + ": has no POSITION and is left out");
      continue;
    }
    GltfPiece piece;
    piece.morph_targets = morph_targets;
    Status status = read_material_id(reader, primitive, where, piece);
    if (status.ok()) status = read_gltf_vertices(reader, primitive, weights, where, piece);
    if (status.ok()) status = read_triangles(reader, primitive, where, piece);
    if (status.ok() && joints) status = pose_gltf_piece(reader, primitive, *joints, where, piece);
    if (status.ok() && !joints && reader.animated)
      status = read_gltf_skin(reader, primitive, where, piece);
    if (!status.ok()) return status.error();
    if (!piece.indices.empty()) finish(reader.scene, piece, mesh);
  }
  if (mesh.skin.size() != mesh.vertices.size()) mesh.skin.clear();  // some pieces have none
  return mesh;
}

}  // namespace

Status read_gltf_meshes(GltfReader& reader) {
  for (std::size_t id = 0; id < reader.model.meshes.size(); ++id) {
    Result<Mesh> mesh = read_mesh(reader, id, reader.model.meshes[id].weights, nullptr);
    if (!mesh.ok()) return mesh.error();
    const bool empty = mesh.value().geometries.empty();
    reader.mesh_ids.push_back(empty ? -1 : static_cast<int>(reader.scene.meshes.size()));
    if (!empty) reader.scene.meshes.push_back(std::move(mesh.value()));
  }
  return {};
}

Result<Mesh> read_morphed_mesh(GltfReader& reader, int mesh, std::span<const double> weights) {
  return read_mesh(reader, static_cast<std::size_t>(mesh), weights, nullptr);
}

std::uint32_t count_morph_targets(const tinygltf::Mesh& mesh) {
  std::size_t most = 0;
  for (const tinygltf::Primitive& primitive : mesh.primitives)
    most = std::max(most, primitive.targets.size());
  return static_cast<std::uint32_t>(most);
}

Result<Mesh> read_morphable_mesh(GltfReader& reader, int mesh, std::span<const double> weights) {
  const auto id = static_cast<std::size_t>(mesh);
  return read_mesh(reader, id, weights, nullptr, count_morph_targets(reader.model.meshes[id]));
}

Result<Mesh> read_skinned_mesh(GltfReader& reader, int mesh, std::span<const double> weights,
                               const std::vector<glm::dmat4>& joints) {
  return read_mesh(reader, static_cast<std::size_t>(mesh), weights, &joints);
}

}  // namespace kaamos::effects
