// SPDX-License-Identifier: MIT
/// @file
/// A mesh, which becomes one bottom-level acceleration structure. Each of its geometries is a piece
/// of one material, like the five of the chairs in the Northlight demo.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace kaamos::effects {

/// One vertex as it lies in memory, for the build and for hit shaders alike: interleaved, so that a
/// hit touches few cache lines and one root SRV serves all attributes. [Northlight deck: Root SRVs
/// and Constants for Vertex Data]
struct Vertex {
  glm::vec3 position{0.0f};  ///< object space, metres
  glm::vec3 normal{0.0f};    ///< object space, unit
  glm::vec4 tangent{0.0f};   ///< xyz unit, w = +1 or -1: bitangent = w * cross(normal, tangent)
  glm::vec2 uv{0.0f};        ///< v = 0 is the top row of an image
};
static_assert(sizeof(Vertex) == 48);

/// Byte offsets of the attributes in a vertex, as hit constants pass them to shaders.
///@{
inline constexpr std::uint32_t kVertexStride = sizeof(Vertex);
inline constexpr std::uint32_t kPositionOffset = offsetof(Vertex, position);
inline constexpr std::uint32_t kNormalOffset = offsetof(Vertex, normal);
inline constexpr std::uint32_t kTangentOffset = offsetof(Vertex, tangent);
inline constexpr std::uint32_t kUvOffset = offsetof(Vertex, uv);
///@}

/// A vertex colour and its opacity, linear, 65535 = 1: the base colour times this. Only meshes that
/// have colours pay for them.
using VertexColor = glm::u16vec4;
/// The colour of a vertex that has none.
inline constexpr VertexColor kWhite{65535, 65535, 65535, 65535};

/// A vertex with a colour or second texture coordinates as it lies in memory on a device: a Vertex,
/// its VertexColor, its second texture coordinates. [Mesh::has_more]
inline constexpr std::uint32_t kColoredVertexStride = 64;

/// Root constants of a hit group's local root signature: how to read the two root SRVs of a
/// geometry, and its material. 32 bytes.
struct HitConstants {
  std::uint32_t vertex_stride = kVertexStride;  ///< bytes
  /// Bytes from the start of a vertex.
  ///@{
  std::uint32_t normal_offset = kNormalOffset;
  std::uint32_t tangent_offset = kTangentOffset;
  std::uint32_t uv_offset = kUvOffset;
  ///@}
  std::uint32_t index_size_bytes = 4;  ///< 2 or 4
  std::uint32_t material_id = 0;       ///< in Scene::materials
  /// Bytes from the start of a vertex, second texture coordinates follow; 0: all are white, and the
  /// second coordinates are the first.
  std::uint32_t color_offset = 0;
  std::uint32_t geometry_id = 0;  ///< in Mesh::geometries
};
static_assert(sizeof(HitConstants) == 32);

/// A range of a mesh with one material: one geometry of the bottom level.
struct Geometry {
  std::uint32_t first_vertex = 0;  ///< in Mesh::vertices; indices count from here
  std::uint32_t vertex_count = 0;  ///< from first_vertex on
  /// The start of the indices in Mesh::indices: a multiple of 16, as raw views have to. A shader
  /// may read 4-byte words up to the next multiple of 4 after the last index.
  std::uint32_t index_offset_bytes = 0;
  std::uint32_t index_count = 0;       ///< a multiple of 3
  std::uint32_t index_size_bytes = 4;  ///< 2 or 4
  std::uint32_t material = 0;          ///< in Scene::materials
  bool alpha_tested = false;           ///< any-hit shaders must run: not opaque
};

/// A box along the axes; empty at first.
struct Bounds {
  /// The corners; min above max on any axis: empty.
  ///@{
  glm::dvec3 min{1e300};
  glm::dvec3 max{-1e300};
  ///@}
  /// True where no point was added.
  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  /// Grows the box so that it holds the point.
  void add(const glm::dvec3& point);
  /// The middle. Precondition: not empty.
  glm::dvec3 center() const { return 0.5 * (min + max); }
  /// The sides; zero where the box is empty.
  glm::dvec3 size() const { return empty() ? glm::dvec3(0.0) : max - min; }
};

/// The joints of its instance's skin that move a vertex. Weights sum to 1; unused ones are 0.
struct SkinVertex {
  glm::u16vec4 joints{0};         ///< in Skin::joints
  glm::vec4 weights{1, 0, 0, 0};  ///< of these joints, 0 to 1
};
static_assert(sizeof(SkinVertex) == 24);

/// The way by which a morph target of full weight moves a vertex. [glTF 2.0: Morph Targets]
struct MorphMove {
  glm::vec3 position{0.0f};  ///< metres
  glm::vec3 normal{0.0f};    ///< added before the normal is scaled to unit length
  glm::vec3 tangent{0.0f};   ///< likewise
};
static_assert(sizeof(MorphMove) == 36);

/// Vertices and indices of several geometries: what becomes one bottom level.
struct Mesh {
  std::string name;                  ///< for people and messages
  std::vector<Vertex> vertices;      ///< of all geometries
  std::vector<SkinVertex> skin;      ///< one per vertex where the mesh is skinned, else empty
  std::vector<VertexColor> colors;   ///< one per vertex, or empty: all are white
  std::vector<glm::vec2> second_uv;  ///< one per vertex, or empty: `uv` [MaterialConstants]
  /// morph_targets moves for each vertex where animations change the weights, else empty.
  std::vector<MorphMove> morph;
  std::uint32_t morph_targets = 0;    ///< that the mesh has; its vertices are those without them
  std::vector<std::uint8_t> indices;  ///< 16- or 32-bit per geometry, little endian
  std::vector<Geometry> geometries;   ///< in the order of GeometryIndex

  /// Appends a piece. Indices count from 0 = vertices[0] of the piece and must lie in it; they are
  /// stored with 16 bits where the piece has at most 65,536 vertices.
  void add_geometry(std::span<const Vertex> piece, std::span<const std::uint32_t> piece_indices,
                    std::uint32_t material, bool alpha_tested);
  /// Gives the vertices of the geometry that was added last these colours; empty: white.
  void add_colors(std::span<const VertexColor> of_last);
  /// The same of second texture coordinates; empty: those of the vertices.
  void add_second_uv(std::span<const glm::vec2> of_last);
  /// Vertices have colours or second texture coordinates, and are longer on a device.
  bool has_more() const { return !colors.empty() || !second_uv.empty(); }
  /// What follows vertex `i` there.
  struct More {
    VertexColor color = kWhite;  ///< linear
    glm::vec2 second_uv{0.0f};   ///< as Vertex::uv
  };
  /// That of vertex `i`, whether the mesh has more or not.
  More more(std::size_t i) const;
  /// Index `i` of a geometry, relative to its first vertex.
  std::uint32_t index(const Geometry& geometry, std::uint32_t i) const;
  /// Corner 0..2 of a triangle of a geometry.
  const Vertex& corner(const Geometry& geometry, std::uint32_t triangle,
                       std::uint32_t corner) const;
  /// Triangles of all geometries.
  std::uint64_t triangle_count() const;
  /// The box of all finite positions, object space.
  Bounds bounds() const;
};

}  // namespace kaamos::effects
