// SPDX-License-Identifier: MIT
// Reads the vertices of a primitive: its attributes, and its morph targets at rest.
#include <algorithm>
#include <cmath>

#include "effects/assets/gltf/gltf_accessor.h"
#include "effects/assets/gltf/gltf_piece.h"

namespace kaamos::effects {
namespace {

Status count_error(const std::string& where, const std::string& name, std::size_t actual,
                   std::size_t expected) {
  return make_error(ErrorId::kGltf, where + ", " + name + ": has " + std::to_string(actual) +
                                        " elements, POSITION has " + std::to_string(expected));
}

/// Adds the morph targets of an attribute to its values, which have `stride` numbers for each
/// vertex, of which targets move the first `components`. [glTF 2.0: Morph Targets]
Status add_targets(const GltfReader& reader, const tinygltf::Primitive& primitive,
                   std::span<const double> weights, const std::string& name,
                   std::uint32_t components, std::uint32_t stride, const std::string& where,
                   std::vector<float>& values) {
  for (std::size_t t = 0; t < std::min(weights.size(), primitive.targets.size()); ++t) {
    const auto found = primitive.targets[t].find(name);
    const auto weight = static_cast<float>(weights[t]);
    if (found == primitive.targets[t].end() || weight == 0.0f || values.empty()) continue;
    const std::string place = where + ", morph target " + std::to_string(t) + ", " + name;
    const Result<std::vector<float>> read =
        read_floats(reader.model, found->second, components, place);
    if (!read.ok()) return read.error();
    const std::vector<float>& moves = read.value();
    if (moves.size() / components != values.size() / stride)
      return count_error(where, "morph target " + std::to_string(t) + ", " + name,
                         moves.size() / components, values.size() / stride);
    for (std::size_t i = 0; i < moves.size(); ++i)
      values[i / components * stride + i % components] += weight * moves[i];
  }
  return {};
}

/// Linear colours; values above 1, which a base colour cannot have, count as 1.
Status read_colors(GltfReader& reader, const tinygltf::Primitive& primitive,
                   std::span<const double> weights, const std::string& where, GltfPiece& piece) {
  const int id = gltf_attribute(primitive, "COLOR_0");
  if (id < 0) return {};
  const std::uint32_t components =
      std::max(3u, std::min(4u, accessor_components(reader.model, id)));
  std::vector<float> values;
  Status status = read_gltf_attribute(reader, primitive, "COLOR_0", components,
                                      piece.vertices.size(), where, values);
  if (status.ok())
    status =
        add_targets(reader, primitive, weights, "COLOR_0", components, components, where, values);
  if (!status.ok()) return status;
  bool above = false, white = true;
  piece.colors.assign(piece.vertices.size(), kWhite);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float value = std::isfinite(values[i]) ? values[i] : 1.0f;
    above |= value > 1.0f;
    const auto part =
        static_cast<std::uint16_t>(std::lround(65535.0f * std::clamp(value, 0.0f, 1.0f)));
    white &= part == 65535;
    piece.colors[i / components][static_cast<int>(i % components)] = part;
  }
  if (above) reader.warn_once(where + ", COLOR_0: values above 1 are taken as 1");
  if (white) piece.colors.clear();
  return {};
}

/// Reads the moves of the targets that a piece keeps.
Status read_moves(const GltfReader& reader, const tinygltf::Primitive& primitive,
                  const std::string& where, GltfPiece& piece) {
  const std::size_t count = piece.vertices.size();
  piece.morph.resize(count * piece.morph_targets);
  struct Part {
    const char* name;
    glm::vec3 MorphMove::*member;
  };
  for (std::size_t t = 0; t < std::min<std::size_t>(piece.morph_targets, primitive.targets.size());
       ++t) {
    for (const Part& part :
         {Part{"POSITION", &MorphMove::position}, Part{"NORMAL", &MorphMove::normal},
          Part{"TANGENT", &MorphMove::tangent}}) {
      const auto found = primitive.targets[t].find(part.name);
      if (found == primitive.targets[t].end()) continue;
      const std::string name = "morph target " + std::to_string(t) + ", " + part.name;
      const Result<std::vector<float>> read =
          read_floats(reader.model, found->second, 3, where + ", " + name);
      if (!read.ok()) return read.error();
      const std::vector<float>& v = read.value();
      if (v.size() != 3 * count) return count_error(where, name, v.size() / 3, count);
      for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 move(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
        if (!std::isfinite(move.x + move.y + move.z))
          return make_error(ErrorId::kGltf, where + ", " + name + ": element " + std::to_string(i) +
                                                " is not finite");
        piece.morph[i * piece.morph_targets + t].*part.member = move;
      }
    }
  }
  return {};
}

bool is_read(const std::string& name) {
  static const char* const kNames[] = {"POSITION", "NORMAL", "TANGENT", "COLOR_0"};
  if (std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames)) return true;
  // The materials say which texture coordinates are read.
  return name.starts_with("TEXCOORD_") || name.starts_with("JOINTS_") ||
         name.starts_with("WEIGHTS_");
}

void warn_of_unread(GltfReader& reader, const tinygltf::Primitive& primitive) {
  for (const auto& [name, accessor] : primitive.attributes)
    if (!is_read(name)) reader.warn_once("the attribute " + name + " is not read");
}

}  // namespace

bool make_unit(glm::vec3& v) {
  const float length = glm::length(v);
  if (!(length > 1e-20f) || !std::isfinite(length)) return false;
  // A unit vector keeps its rounding error, so that a file that is written again keeps its bits.
  if (std::abs(length - 1.0f) > 3e-7f) v /= length;
  return true;
}

int gltf_attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

Status read_gltf_attribute(const GltfReader& reader, const tinygltf::Primitive& primitive,
                           const std::string& name, std::uint32_t components, std::size_t count,
                           const std::string& where, std::vector<float>& values) {
  const int id = gltf_attribute(primitive, name);
  if (id < 0) return {};
  Result<std::vector<float>> read = read_floats(reader.model, id, components, where + ", " + name);
  if (!read.ok()) return read.error();
  if (read.value().size() != count * components)
    return count_error(where, name, read.value().size() / components, count);
  values = std::move(read.value());
  return {};
}

Status read_gltf_vertices(GltfReader& reader, const tinygltf::Primitive& primitive,
                          std::span<const double> weights, const std::string& where,
                          GltfPiece& piece) {
  warn_of_unread(reader, primitive);
  Result<std::vector<float>> read =
      read_floats(reader.model, gltf_attribute(primitive, "POSITION"), 3, where + ", POSITION");
  if (!read.ok()) return read.error();
  std::vector<float> p = std::move(read.value());
  const std::size_t count = p.size() / 3;
  const GltfReader::UvSets sets = piece.material < reader.uv_sets.size()
                                      ? reader.uv_sets[piece.material]
                                      : GltfReader::UvSets();
  std::vector<float> normals, tangents, uvs, second_uvs;
  const auto attribute = [&](const std::string& name, std::uint32_t components, std::uint32_t moved,
                             std::vector<float>& values) -> Status {
    Status status = read_gltf_attribute(reader, primitive, name, components, count, where, values);
    const bool is_kept = piece.morph_targets > 0 && moved == 3;
    if (status.ok() && !is_kept)
      status = add_targets(reader, primitive, weights, name, moved, components, where, values);
    return status;
  };
  Status status;
  if (piece.morph_targets == 0)
    status = add_targets(reader, primitive, weights, "POSITION", 3, 3, where, p);
  if (status.ok()) status = attribute("NORMAL", 3, 3, normals);
  if (status.ok()) status = attribute("TANGENT", 4, 3, tangents);
  if (status.ok()) status = attribute("TEXCOORD_" + std::to_string(sets.first), 2, 2, uvs);
  if (status.ok() && sets.second >= 0)
    status = attribute("TEXCOORD_" + std::to_string(sets.second), 2, 2, second_uvs);
  if (!status.ok()) return status;
  piece.vertices.resize(count);
  if (!second_uvs.empty()) piece.second_uv.resize(count);
  piece.has_normals = !normals.empty();
  piece.has_tangents = piece.has_normals && !tangents.empty();
  for (std::size_t v = 0; v < count; ++v) {
    Vertex& vertex = piece.vertices[v];
    vertex.position = glm::vec3(p[3 * v], p[3 * v + 1], p[3 * v + 2]);
    for (std::size_t c = 0; c < 3; ++c)
      if (!std::isfinite(p[3 * v + c]))
        return make_error(ErrorId::kGltf,
                          where + ", POSITION: element " + std::to_string(v) + " is not finite");
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
    if (!second_uvs.empty() && std::isfinite(second_uvs[2 * v] + second_uvs[2 * v + 1]))
      piece.second_uv[v] = glm::vec2(second_uvs[2 * v], second_uvs[2 * v + 1]);
  }
  if (piece.morph_targets > 0) status = read_moves(reader, primitive, where, piece);
  if (!status.ok()) return status;
  return read_colors(reader, primitive, weights, where, piece);
}

}  // namespace kaamos::effects
