// SPDX-License-Identifier: MIT
#include "effects/assets/scene/material_override.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

namespace kaamos::effects {
namespace {

constexpr std::size_t kMostNames = 40;  // names that an error lists at most

struct Key {
  const char* name;
  float low, high;
  void (*apply)(MaterialConstants& material, float value);
};

void set_flag(MaterialConstants& material, std::uint32_t flag, bool on) {
  material.flags = on ? material.flags | flag : material.flags & ~flag;
}

// Makes glass of uniform coverage, or an opaque material; either drops the alpha test of a texture.
void set_alpha(MaterialConstants& material, float value) {
  material.base_color.a = value;
  set_flag(material, kMaterialMask | kMaterialAlphaTested, false);
  set_flag(material, kMaterialBlend, value < 1.0f);
}

constexpr float kAny = std::numeric_limits<float>::max();

const Key kKeys[] = {
    {"alpha", 0, 1, set_alpha},
    {"roughness", 0, 1, [](MaterialConstants& m, float v) { m.roughness = v; }},
    {"metallic", 0, 1, [](MaterialConstants& m, float v) { m.metallic = v; }},
    {"red", 0, 1, [](MaterialConstants& m, float v) { m.base_color.r = v; }},
    {"green", 0, 1, [](MaterialConstants& m, float v) { m.base_color.g = v; }},
    {"blue", 0, 1, [](MaterialConstants& m, float v) { m.base_color.b = v; }},
    {"emission", 0, kAny, [](MaterialConstants& m, float v) { m.emissive = glm::vec3(v); }},
    {"two_sided", 0, 1,
     [](MaterialConstants& m, float v) { set_flag(m, kMaterialDoubleSided, v >= 0.5f); }},
};

const Key* find_key(std::string_view name) {
  const auto found = std::find_if(std::begin(kKeys), std::end(kKeys),
                                  [&](const Key& key) { return name == key.name; });
  return found == std::end(kKeys) ? nullptr : found;
}

std::string known_keys() {
  std::string list;
  for (const Key& key : kKeys) list += (list.empty() ? "" : ", ") + std::string(key.name);
  return list;
}

Error bad(const std::string& text, const std::string& what) {
  return make_error(ErrorId::kMaterialOverride, "\"" + text + "\": " + what);
}

std::string range_of(const Key& key) {
  return key.high == kAny ? "0 or more" : "0 to 1";
}

// Parses one KEY=VALUE.
Status parse_value(const std::string& text, std::string_view part, MaterialOverride& out) {
  const std::size_t equals = part.find('=');
  if (equals == std::string_view::npos) {
    return bad(text, "\"" + std::string(part) + "\" is not KEY=VALUE; keys are " + known_keys());
  }
  const std::string name(part.substr(0, equals));
  const std::string_view digits = part.substr(equals + 1);
  const Key* key = find_key(name);
  if (key == nullptr) {
    return bad(text, "key \"" + name + "\" is unknown; keys are " + known_keys());
  }
  float value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    return bad(text, name + " is \"" + std::string(digits) + "\", which is not a number");
  }
  if (!(value >= key->low && value <= key->high)) {
    return bad(text, name + " is " + std::string(digits) + ", " + range_of(*key) + " is allowed");
  }
  out.values.emplace_back(name, value);
  return {};
}

bool is_glass(const Scene& scene, const Geometry& geometry) {
  const std::uint32_t flags = scene.materials[geometry.material].constants.flags;
  return (flags & kMaterialBlend) && !(flags & kMaterialAlphaTested);
}

// If a mesh has both glass and opaque pieces, moves the glass to a new mesh. The buffers are
// copied, because pieces name ranges of them.
bool split_glass(Scene& scene, std::uint32_t mesh_id) {
  const auto glass = [&](const Geometry& geometry) { return is_glass(scene, geometry); };
  Mesh& mesh = scene.meshes[mesh_id];
  const auto count = std::count_if(mesh.geometries.begin(), mesh.geometries.end(), glass);
  if (count == 0 || count == static_cast<std::ptrdiff_t>(mesh.geometries.size())) return false;
  Mesh panes = mesh;
  panes.name += " (glass)";
  std::erase_if(panes.geometries, [&](const Geometry& geometry) { return !glass(geometry); });
  std::erase_if(mesh.geometries, glass);
  scene.meshes.push_back(std::move(panes));
  return true;
}

}  // namespace

void separate_glass(Scene& scene) {
  const std::size_t mesh_count = scene.meshes.size();
  for (std::uint32_t id = 0; id < mesh_count; ++id) {
    if (!split_glass(scene, id)) continue;
    const std::uint32_t panes = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    const std::size_t instance_count = scene.instances.size();
    for (std::size_t i = 0; i < instance_count; ++i) {
      if (scene.instances[i].mesh != id) continue;
      Instance copy = scene.instances[i];
      copy.mesh = panes;
      copy.mask = kMaskTransparent;
      scene.instances.push_back(std::move(copy));
    }
  }
}

namespace {

// An instance's mask says whether it is glass, so a mesh must be either all glass or none.
void sort_glass(Scene& scene) {
  separate_glass(scene);
  for (Instance& instance : scene.instances) {
    const std::vector<Geometry>& pieces = scene.meshes[instance.mesh].geometries;
    const bool glass = !pieces.empty() && is_glass(scene, pieces.front());
    if (glass) {
      instance.mask = kMaskTransparent;
    } else if (instance.mask == kMaskTransparent) {
      instance.mask = kMaskOpaque;
    }
  }
}

std::string names_of(const Scene& scene) {
  std::string list;
  for (std::size_t i = 0; i < scene.materials.size() && i < kMostNames; ++i) {
    list += (i == 0 ? "\"" : ", \"") + scene.materials[i].name + "\"";
  }
  if (scene.materials.size() > kMostNames) {
    list += " and " + std::to_string(scene.materials.size() - kMostNames) + " more";
  }
  return list;
}

}  // namespace

Result<MaterialOverride> parse_material_override(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) {
    return bad(text, "NAME:KEY=VALUE[,KEY=VALUE...] is wanted; keys are " + known_keys());
  }
  MaterialOverride out;
  out.name = text.substr(0, colon);
  std::string_view rest = std::string_view(text).substr(colon + 1);
  while (true) {
    const std::size_t comma = rest.find(',');
    if (const Status parsed = parse_value(text, rest.substr(0, comma), out); !parsed.ok()) {
      return parsed.error();
    }
    if (comma == std::string_view::npos) return out;
    rest = rest.substr(comma + 1);
  }
}

Status override_material(Scene& scene, const MaterialOverride& change) {
  bool found = false;
  for (Material& material : scene.materials) {
    if (material.name != change.name) continue;
    found = true;
    for (const auto& [name, value] : change.values) {
      const Key* key = find_key(name);
      if (key == nullptr) {
        return bad(change.name, "key \"" + name + "\" is unknown; keys are " + known_keys());
      }
      key->apply(material.constants, value);
    }
  }
  if (!found) {
    return make_error(ErrorId::kMaterialOverride,
                      "scene \"" + scene.name + "\" has no material \"" + change.name +
                          "\" to override; its materials are " + names_of(scene));
  }
  const bool alpha = std::any_of(change.values.begin(), change.values.end(),
                                 [](const auto& value) { return value.first == "alpha"; });
  if (!alpha) return {};
  for (Mesh& mesh : scene.meshes) {
    for (Geometry& geometry : mesh.geometries) {
      if (scene.materials[geometry.material].name != change.name) continue;
      const std::uint32_t flags = scene.materials[geometry.material].constants.flags;
      geometry.alpha_tested = (flags & kMaterialAlphaTested) != 0;
    }
  }
  sort_glass(scene);
  return {};
}

}  // namespace kaamos::effects
