// SPDX-License-Identifier: MIT
// A primitive of a glTF file on its way to a geometry; only gltf_*.cpp include it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/gltf/gltf_reader.h"

namespace kaamos::effects {

/// The triangles of one primitive, before they become a geometry.
struct GltfPiece {
  std::vector<Vertex> vertices;
  std::vector<SkinVertex> skin;      // empty, or one per vertex
  std::vector<VertexColor> colors;   // empty, or one per vertex
  std::vector<glm::vec2> second_uv;  // empty, or one per vertex
  std::vector<std::uint32_t> indices;
  std::vector<MorphMove> morph;  // morph_targets for each vertex
  std::uint32_t material = 0;
  bool has_normals = false;
  bool has_tangents = false;
  /// Set before reading: targets to keep instead of applying them to positions and directions.
  std::uint32_t morph_targets = 0;
};

/// The accessor of an attribute, or -1.
int gltf_attribute(const tinygltf::Primitive& primitive, const std::string& name);

/// Reads an optional attribute. `values` stays empty if the primitive does not have it.
Status read_gltf_attribute(const GltfReader& reader, const tinygltf::Primitive& primitive,
                           const std::string& name, std::uint32_t components, std::size_t count,
                           const std::string& where, std::vector<float>& values);

/// Reads the vertices of a primitive, its morph targets applied with these weights unless they are
/// kept.
Status read_gltf_vertices(GltfReader& reader, const tinygltf::Primitive& primitive,
                          std::span<const double> weights, const std::string& where,
                          GltfPiece& piece);

/// Applies the weighted joints to each vertex in place. [glTF 2.0: Skins]
Status pose_gltf_piece(const GltfReader& reader, const tinygltf::Primitive& primitive,
                       const std::vector<glm::dmat4>& joints, const std::string& where,
                       GltfPiece& piece);

/// Reads joints and weights, and scales the weights to a sum of 1. Vertices without weights follow
/// the first joint; of more than four joints the four with the largest weights count.
Status read_gltf_skin(GltfReader& reader, const tinygltf::Primitive& primitive,
                      const std::string& where, GltfPiece& piece);

/// Scales to unit length; false where the vector has none.
bool make_unit(glm::vec3& v);

}  // namespace kaamos::effects
