// SPDX-License-Identifier: MIT
// Reads the meshes of a glTF file: one mesh with one geometry per primitive.
#include <algorithm>
#include <cmath>

#include "effects/assets/gltf/gltf_accessor.h"
#include "effects/assets/gltf/gltf_reader.h"
#include "effects/assets/scene/tangents.h"

namespace kaamos::effects {
namespace {

/// The triangles of one primitive, before they become a geometry.
struct Piece {
  std::vector<Vertex> vertices;
  std::vector<SkinVertex> skin;  // empty, or one per vertex
  std::vector<std::uint32_t> indices;
  std::uint32_t material = 0;
  bool has_normals = false;
  bool has_tangents = false;
};

int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

Status count_error(const std::string& where, const char* name, std::size_t actual,
                   std::size_t expected) {
  return make_error(ErrorId::kGltf, where + ", " + name + ": has " + std::to_string(actual) +
                                        " elements, POSITION has " + std::to_string(expected));
}

/// Reads an optional attribute. `values` stays empty if the primitive does not have it.
Status optional_attribute(const GltfReader& reader, const tinygltf::Primitive& primitive,
                          const char* name, std::uint32_t components, std::size_t count,
                          const std::string& where, std::vector<float>& values) {
  const int id = attribute(primitive, name);
  if (id < 0) return {};
  Result<std::vector<float>> read = read_floats(reader.model, id, components, where + ", " + name);
  if (!read.ok()) return read.error();
  if (read.value().size() != count * components)
    return count_error(where, name, read.value().size() / components, count);
  values = std::move(read.value());
  return {};
}

bool make_unit(glm::vec3& v) {
  const float length = glm::length(v);
  if (!(length > 1e-20f) || !std::isfinite(length)) return false;
  // What a unit vector loses by rounding stays, so that a file that is written again keeps its
  // bits.
  if (std::abs(length - 1.0f) > 3e-7f) v /= length;
  return true;
}

Status read_positions(const GltfReader& reader, const tinygltf::Primitive& primitive,
                      const std::string& where, Piece& piece) {
  const Result<std::vector<float>> positions =
      read_floats(reader.model, attribute(primitive, "POSITION"), 3, where + ", POSITION");
  if (!positions.ok()) return positions.error();
  const std::vector<float>& p = positions.value();
  piece.vertices.resize(p.size() / 3);
  for (std::size_t v = 0; v < piece.vertices.size(); ++v) {
    piece.vertices[v].position = glm::vec3(p[3 * v], p[3 * v + 1], p[3 * v + 2]);
    for (std::size_t c = 0; c < 3; ++c)
      if (!std::isfinite(p[3 * v + c]))
        return make_error(ErrorId::kGltf,
                          where + ", POSITION: element " + std::to_string(v) + " is not finite");
  }
  return {};
}

Status read_vertices(const GltfReader& reader, const tinygltf::Primitive& primitive,
                     const std::string& where, Piece& piece) {
  Status status = read_positions(reader, primitive, where, piece);
  if (!status.ok()) return status;
  const std::size_t count = piece.vertices.size();
  std::vector<float> normals, tangents, uvs;
  status = optional_attribute(reader, primitive, "NORMAL", 3, count, where, normals);
  if (status.ok())
    status = optional_attribute(reader, primitive, "TANGENT", 4, count, where, tangents);
  if (status.ok())
    status = optional_attribute(reader, primitive, "TEXCOORD_0", 2, count, where, uvs);
  if (!status.ok()) return status;
  piece.has_normals = !normals.empty();
  piece.has_tangents = piece.has_normals && !tangents.empty();
  for (std::size_t v = 0; v < count; ++v) {
    Vertex& vertex = piece.vertices[v];
    if (!normals.empty()) {
      vertex.normal = glm::vec3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
      piece.has_normals &= make_unit(vertex.normal);
    }
    if (!tangents.empty()) {
      glm::vec3 tangent(tangents[4 * v], tangents[4 * v + 1], tangents[4 * v + 2]);
      piece.has_tangents &= make_unit(tangent);
      vertex.tangent = glm::vec4(tangent, tangents[4 * v + 3] < 0.0f ? -1.0f : 1.0f);
    }
    if (!uvs.empty() && std::isfinite(uvs[2 * v]) && std::isfinite(uvs[2 * v + 1]))
      vertex.uv = glm::vec2(uvs[2 * v], uvs[2 * v + 1]);
  }
  return {};
}

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
                      const std::string& where, Piece& piece) {
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
                        const std::string& where, Piece& piece) {
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

void finish(const Scene& scene, Piece& piece, Mesh& mesh) {
  if (!piece.has_normals) {
    if (!piece.skin.empty()) {
      std::vector<SkinVertex> skin;
      for (const std::uint32_t i : piece.indices) skin.push_back(piece.skin[i]);
      piece.skin = std::move(skin);
    }
    make_flat_normals(piece.vertices, piece.indices);
    piece.has_tangents = false;
  }
  if (!piece.has_tangents) make_tangents(piece.vertices, piece.indices);
  const bool alpha_tested =
      (scene.materials[piece.material].constants.flags & kMaterialAlphaTested) != 0;
  mesh.skin.insert(mesh.skin.end(), piece.skin.begin(), piece.skin.end());
  mesh.add_geometry(piece.vertices, piece.indices, piece.material, alpha_tested);
}

bool is_triangles(int mode) {
  return mode < 0 || mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

/// Applies the weighted joints to each vertex in place. [glTF 2.0: Skins]
Status pose(const GltfReader& reader, const tinygltf::Primitive& primitive,
            const std::vector<glm::dmat4>& joints, const std::string& where, Piece& piece) {
  std::vector<float> ids, weights;
  const std::size_t count = piece.vertices.size();
  Status status = optional_attribute(reader, primitive, "JOINTS_0", 4, count, where, ids);
  if (status.ok())
    status = optional_attribute(reader, primitive, "WEIGHTS_0", 4, count, where, weights);
  if (!status.ok() || ids.empty() || weights.empty()) return status;
  for (std::size_t v = 0; v < count; ++v) {
    glm::dmat4 m(0.0);
    double sum = 0.0;
    for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
      if (!(weights[k] > 0.0f) || !std::isfinite(weights[k])) continue;
      const std::size_t joint = static_cast<std::size_t>(std::max(0.0f, ids[k]));
      if (joint >= joints.size())
        return make_error(ErrorId::kGltf, where + ", JOINTS_0: element " + std::to_string(v) +
                                              " names joint " + std::to_string(joint) + " of " +
                                              std::to_string(joints.size()));
      m += joints[joint] * static_cast<double>(weights[k]);
      sum += weights[k];
    }
    if (sum <= 0.0) continue;
    m /= sum;
    Vertex& vertex = piece.vertices[v];
    vertex.position = glm::vec3(m * glm::dvec4(glm::dvec3(vertex.position), 1.0));
    vertex.normal =
        glm::vec3(glm::transpose(glm::inverse(glm::dmat3(m))) * glm::dvec3(vertex.normal));
    piece.has_normals &= make_unit(vertex.normal);
    glm::vec3 tangent(glm::dmat3(m) * glm::dvec3(vertex.tangent));
    piece.has_tangents &= make_unit(tangent);
    vertex.tangent = glm::vec4(tangent, vertex.tangent.w);
    const glm::vec3& p = vertex.position;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return make_error(ErrorId::kGltf, where + ": element " + std::to_string(v) +
                                            " is not finite in the pose of its skin");
  }
  return {};
}

/// Reads joints and weights, and scales the weights to a sum of 1. Vertices without weights follow
/// the first joint.
Status read_skin(const GltfReader& reader, const tinygltf::Primitive& primitive,
                 const std::string& where, Piece& piece) {
  std::vector<float> ids, weights;
  const std::size_t count = piece.vertices.size();
  Status status = optional_attribute(reader, primitive, "JOINTS_0", 4, count, where, ids);
  if (status.ok())
    status = optional_attribute(reader, primitive, "WEIGHTS_0", 4, count, where, weights);
  if (!status.ok() || ids.empty() || weights.empty()) return status;
  piece.skin.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    SkinVertex& to = piece.skin[v];
    float sum = 0.0f;
    for (std::size_t k = 0; k < 4; ++k) {
      const float weight = weights[4 * v + k];
      const bool used = weight > 0.0f && std::isfinite(weight);
      const int lane = static_cast<int>(k);
      to.weights[lane] = used ? weight : 0.0f;
      to.joints[lane] =
          used ? static_cast<std::uint16_t>(std::clamp(ids[4 * v + k], 0.0f, 65535.0f)) : 0;
      sum += to.weights[lane];
    }
    to.weights = sum > 0.0f && std::isfinite(sum) ? to.weights / sum : glm::vec4(1, 0, 0, 0);
  }
  return {};
}

Result<Mesh> read_mesh(GltfReader& reader, std::size_t id, const std::vector<glm::dmat4>* joints) {
  const tinygltf::Mesh& from = reader.model.meshes[id];
  const std::string mesh_where = gltf_part("mesh", id, from.name);
  Mesh mesh;
  mesh.name = from.name.empty() ? "mesh " + std::to_string(id) : from.name;
  for (std::size_t i = 0; i < from.primitives.size(); ++i) {
    const tinygltf::Primitive& primitive = from.primitives[i];
    const std::string where = mesh_where + ", primitive " + std::to_string(i);
    if (!is_triangles(primitive.mode)) {
      if (!joints) reader.warn(where + ": is made of points or lines and is left out");
      continue;
    }
    if (attribute(primitive, "POSITION") < 0) {
      if (!joints) reader.warn(where + ": has no POSITION and is left out");
      continue;
    }
    if (!primitive.targets.empty() && !joints) reader.warn(where + ": morph targets are left out");
    Piece piece;
    Status status = read_vertices(reader, primitive, where, piece);
    if (status.ok()) status = read_triangles(reader, primitive, where, piece);
    if (status.ok()) status = read_material_id(reader, primitive, where, piece);
    if (status.ok() && joints) status = pose(reader, primitive, *joints, where, piece);
    if (status.ok() && !joints && reader.animated)
      status = read_skin(reader, primitive, where, piece);
    if (!status.ok()) return status.error();
    if (!piece.indices.empty()) finish(reader.scene, piece, mesh);
  }
  if (mesh.skin.size() != mesh.vertices.size()) mesh.skin.clear();  // some pieces have none
  return mesh;
}

}  // namespace

Status read_gltf_meshes(GltfReader& reader) {
  for (std::size_t id = 0; id < reader.model.meshes.size(); ++id) {
    Result<Mesh> mesh = read_mesh(reader, id, nullptr);
    if (!mesh.ok()) return mesh.error();
    const bool empty = mesh.value().geometries.empty();
    reader.mesh_ids.push_back(empty ? -1 : static_cast<int>(reader.scene.meshes.size()));
    if (!empty) reader.scene.meshes.push_back(std::move(mesh.value()));
  }
  return {};
}

Result<Mesh> read_skinned_mesh(GltfReader& reader, int mesh,
                               const std::vector<glm::dmat4>& joints) {
  return read_mesh(reader, static_cast<std::size_t>(mesh), &joints);
}

}  // namespace kaamos::effects
