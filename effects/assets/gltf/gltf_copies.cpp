// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_copies.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "effects/assets/gltf/gltf_accessor.h"

namespace kaamos::effects {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

/// Most instances of a node: their accessors may have no data, so that a file of 200 bytes could
/// request any amount of memory.
constexpr std::size_t kMostCopies = std::size_t{1} << 20;

/// Translations, rotations and scales; each may be empty.
struct Attributes {
  std::vector<float> translation;
  std::vector<float> rotation;
  std::vector<float> scale;
  std::size_t count = 0;
};

Result<Attributes> read_attributes(GltfReader& reader, const tinygltf::Value& from,
                                   const std::string& where) {
  Attributes out;
  bool is_first = true;
  for (const std::string& name : from.Keys()) {
    const bool turns = name == "ROTATION";
    std::vector<float>* to = turns                   ? &out.rotation
                             : name == "TRANSLATION" ? &out.translation
                             : name == "SCALE"       ? &out.scale
                                                     : nullptr;
    if (!to) {
      reader.warn_once(std::string(kExtension) + ": the attribute " + name + " is not read");
      continue;
    }
    const tinygltf::Value& id = from.Get(name);
    if (!id.IsInt()) return make_error(ErrorId::kGltf, where + ", " + name + ": is no accessor");
    Result<std::vector<float>> read =
        read_floats(reader.model, id.GetNumberAsInt(), turns ? 4 : 3, where + ", " + name);
    if (!read.ok()) return read.error();
    const std::size_t count = read.value().size() / (turns ? 4 : 3);
    if (!is_first && count != out.count)
      return make_error(ErrorId::kGltf, where + ", " + name + ": has " + std::to_string(count) +
                                            " elements, another attribute has " +
                                            std::to_string(out.count));
    if (count > kMostCopies)
      return make_error(ErrorId::kGltf, where + ", " + name + ": has " + std::to_string(count) +
                                            " elements, " + std::to_string(kMostCopies) +
                                            " are allowed");
    is_first = false;
    out.count = count;
    *to = std::move(read.value());
  }
  return out;
}

glm::dmat4 transform(const Attributes& from, std::size_t i) {
  glm::dmat4 m(1.0);
  if (!from.rotation.empty()) {
    const float* r = &from.rotation[4 * i];
    const glm::dquat q(static_cast<double>(r[3]), static_cast<double>(r[0]),
                       static_cast<double>(r[1]), static_cast<double>(r[2]));
    const double length = glm::length(q);
    if (length > 0.0 && std::isfinite(length)) m = glm::mat4_cast(q / length);
  }
  for (int c = 0; c < 3; ++c) {
    const std::size_t k = 3 * i + static_cast<std::size_t>(c);
    if (!from.scale.empty()) m[c] *= static_cast<double>(from.scale[k]);
    if (!from.translation.empty()) m[3][c] = static_cast<double>(from.translation[k]);
  }
  return m;
}

}  // namespace

Result<std::vector<GltfCopy>> read_gltf_copies(GltfReader& reader, const tinygltf::Node& node,
                                               const std::string& where) {
  const auto found = node.extensions.find(kExtension);
  if (found == node.extensions.end() || !found->second.Has("attributes") ||
      !found->second.Get("attributes").IsObject())
    return std::vector<GltfCopy>();
  const Result<Attributes> attributes =
      read_attributes(reader, found->second.Get("attributes"), where + ", " + kExtension);
  if (!attributes.ok()) return attributes.error();
  const std::string name = node.name.empty() ? where : node.name;
  std::vector<GltfCopy> out;
  out.reserve(attributes.value().count);
  for (std::size_t i = 0; i < attributes.value().count; ++i)
    out.push_back({name + " " + std::to_string(i), transform(attributes.value(), i)});
  return out;
}

}  // namespace kaamos::effects
