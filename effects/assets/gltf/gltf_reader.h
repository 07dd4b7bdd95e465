// SPDX-License-Identifier: MIT
// The stages of the glTF loader; only gltf_*.cpp include it.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/gltf/gltf_extras.h"
#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The state that the stages share: the parsed file, the scene under construction, and the
/// warnings.
struct GltfReader {
  const tinygltf::Model& model;
  /// Per image of the file: its encoded bytes if it came by URI, else empty.
  const std::vector<std::vector<std::uint8_t>>& encoded_images;
  Scene& scene;
  std::vector<std::string>& warnings;
  /// Per mesh of the file: its index in Scene::meshes, or -1 if it has no triangles.
  std::vector<int> mesh_ids = {};
  /// The TEXCOORD_n that the textures of a material are read with; second: -1, no texture is.
  struct UvSets {
    int first = 0;
    int second = -1;
  };
  /// Per material of the file.
  std::vector<UvSets> uv_sets = {};
  /// Keep what moves instead of the file's pose.
  bool animated = false;
  /// Per node of the file: its index in Scene::nodes, or kNoIndex if the scene does not have it.
  std::vector<std::int32_t> node_ids = {};
  /// By node of the file: what the spot there throws.
  std::map<std::size_t, ProjectionMap> slides = {};
  /// A light of the scene that its node marks as the sun.
  struct MarkedSun {
    std::size_t light;  // in Scene::lights
    SunExtras extras;
  };
  std::optional<MarkedSun> sun = {};

  /// The first node whose transform is singular, so that its mesh is left out.
  std::string singular = {};
  /// A mesh has primitives that are no triangles, which are left out.
  bool has_points_or_lines = false;
  /// The texts that warn_once has said.
  std::set<std::string> said = {};

  void warn(std::string text) { warnings.push_back(std::move(text)); }
  /// The same for what many parts of a file may have alike.
  void warn_once(const std::string& text) {
    if (said.insert(text).second) warn(text);
  }
};

/// `noun 3 "name"`, as messages name a part of a file.
std::string gltf_part(const char* noun, std::size_t index, const std::string& name);

/// Reads one material per material of the file, adds the default material, and reads what spots
/// throw.
Status read_gltf_materials(GltfReader& reader);
/// Reads each mesh of the file that has triangles.
Status read_gltf_meshes(GltfReader& reader);
/// Reads instances, lights and cameras of the default scene's nodes.
Status read_gltf_nodes(GltfReader& reader);

/// Reads the levels of detail that the node names for its instance.
Status read_gltf_levels(GltfReader& reader, const tinygltf::Node& node, const std::string& where,
                        Instance& instance);
/// If `animated`, reads one animation per animation of the file.
Status read_gltf_animations(GltfReader& reader);

/// Reads a mesh with morph weights that are not its own.
Result<Mesh> read_morphed_mesh(GltfReader& reader, int mesh, std::span<const double> weights);
/// Morph targets of a mesh of the file.
std::uint32_t count_morph_targets(const tinygltf::Mesh& mesh);
/// Reads a mesh with its morph targets, for weights that move. Texture coordinates and colours are
/// those of the weights at rest.
Result<Mesh> read_morphable_mesh(GltfReader& reader, int mesh, std::span<const double> weights);
/// Reads a mesh in the pose that the file's joints have, in world space. `joints` are the nodes'
/// object-to-world transforms times the inverse bind matrices.
Result<Mesh> read_skinned_mesh(GltfReader& reader, int mesh, std::span<const double> weights,
                               const std::vector<glm::dmat4>& joints);

}  // namespace kaamos::effects
