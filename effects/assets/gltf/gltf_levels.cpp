// SPDX-License-Identifier: MIT
// Reads the levels of detail of a glTF node. [MSFT_lod]
#include <algorithm>
#include <string>

#include "effects/assets/gltf/gltf_reader.h"
#include "effects/assets/scene/levels.h"

namespace kaamos::effects {
namespace {

bool same_place(const tinygltf::Node& a, const tinygltf::Node& b) {
  return a.matrix == b.matrix && a.translation == b.translation && a.rotation == b.rotation &&
         a.scale == b.scale;
}

// One number per level, from 0 to 1 and none larger than the one before; empty if the file has no
// usable ones. A last number, below which nothing would be shown, is ignored.
std::vector<float> coverages(GltfReader& reader, const tinygltf::Node& node,
                             const std::string& where, std::size_t levels) {
  if (!node.extras.IsObject() || !node.extras.Has("MSFT_screencoverage")) return {};
  const tinygltf::Value& list = node.extras.Get("MSFT_screencoverage");
  std::vector<float> out;
  bool usable = list.IsArray() && list.ArrayLen() >= levels;
  for (std::size_t i = 0; usable && i < levels; ++i) {
    const tinygltf::Value& entry = list.Get(static_cast<int>(i));
    const double value = entry.IsNumber() ? entry.GetNumberAsDouble() : -1;
    usable = value >= 0 && value <= 1 && (out.empty() || value <= out.back());
    out.push_back(static_cast<float>(value));
  }
  if (usable) return out;
  reader.warn(where + ": MSFT_screencoverage is not a falling list of " + std::to_string(levels) +
              " numbers from 0 to 1; each level is used at half the size of the one before");
  return {};
}

}  // namespace

Status read_gltf_levels(GltfReader& reader, const tinygltf::Node& node, const std::string& where,
                        Instance& instance) {
  const auto found = node.extensions.find("MSFT_lod");
  if (found == node.extensions.end() || !found->second.Has("ids") ||
      !found->second.Get("ids").IsArray())
    return {};
  const tinygltf::Value& ids = found->second.Get("ids");
  std::vector<std::uint32_t> meshes = {instance.mesh};
  for (std::size_t i = 0; i < ids.ArrayLen(); ++i) {
    const tinygltf::Value& entry = ids.Get(static_cast<int>(i));
    const int id = entry.IsInt() ? entry.GetNumberAsInt() : -1;
    if (id < 0 || static_cast<std::size_t>(id) >= reader.model.nodes.size())
      return make_error(ErrorId::kGltf, where + ", MSFT_lod: names node " + std::to_string(id) +
                                            " of " + std::to_string(reader.model.nodes.size()));
    const tinygltf::Node& level = reader.model.nodes[static_cast<std::size_t>(id)];
    if (level.mesh < 0 || static_cast<std::size_t>(level.mesh) >= reader.mesh_ids.size() ||
        reader.mesh_ids[static_cast<std::size_t>(level.mesh)] < 0 || level.skin >= 0 ||
        !same_place(node, level)) {
      reader.warn(where + ", MSFT_lod: node " + std::to_string(id) +
                  " has no triangles, a skin, or another transform; the level is left out");
      continue;
    }
    meshes.push_back(
        static_cast<std::uint32_t>(reader.mesh_ids[static_cast<std::size_t>(level.mesh)]));
  }
  if (meshes.size() == 1) return {};
  std::vector<float> limits = coverages(reader, node, where, meshes.size());
  if (limits.empty()) limits = default_coverages(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) instance.levels.push_back({meshes[i], limits[i]});
  return {};
}

}  // namespace kaamos::effects
