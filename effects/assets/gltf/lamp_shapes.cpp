// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/lamp_shapes.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace kaamos::effects {

namespace {

constexpr double kLargestPart = 0.1;  // of the scene's size

bool glows(const MaterialConstants& material) {
  return material.emissive != glm::vec3(0.0f) && material.image[kEmissiveTexture] == kNoTexture;
}

// A geometry as a mesh of its own.
Mesh mesh_of(const Mesh& mesh, const Geometry& geometry) {
  Mesh out;
  out.name = mesh.name;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < geometry.index_count; ++i) {
    indices.push_back(mesh.index(geometry, i));
  }
  out.add_geometry(std::span(mesh.vertices).subspan(geometry.first_vertex, geometry.vertex_count),
                   indices, geometry.material, geometry.alpha_tested);
  if (!mesh.colors.empty())
    out.add_colors(std::span(mesh.colors).subspan(geometry.first_vertex, geometry.vertex_count));
  if (!mesh.second_uv.empty())
    out.add_second_uv(
        std::span(mesh.second_uv).subspan(geometry.first_vertex, geometry.vertex_count));
  return out;
}

// World bounds of one mesh under a transform.
Bounds placed(const Bounds& box, const glm::dmat4& transform) {
  Bounds out;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                        corner & 4 ? box.max.z : box.min.z);
    out.add(glm::dvec3(transform * glm::dvec4(at, 1.0)));
  }
  return out;
}

bool holds_lamp(const Bounds& box, const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(), [&](const Light& light) {
    const glm::dvec3& p = light.position;
    return light.type != LightType::kDirectional && light.intensity > 0.0f &&
           glm::all(glm::greaterThanEqual(p, box.min)) && glm::all(glm::lessThanEqual(p, box.max));
  });
}

// Takes lamp shapes out of instances. Instances that lose the same geometries of a mesh share what
// is left.
class Separation {
 public:
  explicit Separation(Scene& scene)
      : scene_(scene), size_(glm::length(scene_bounds(scene).size())) {}

  std::size_t run() {
    std::vector<Instance> instances = std::move(scene_.instances);
    scene_.instances.clear();
    for (Instance& instance : instances) take_from(std::move(instance));
    return count_;
  }

 private:
  void take_from(Instance instance) {
    std::vector<std::size_t> lamps;
    if (instance.mask == kMaskOpaque && instance.levels.empty() &&
        instance.motion.skin == kNoIndex && instance.motion.morph == kNoIndex) {
      lamps = lamps_of(instance);
    }
    count_ += lamps.size();
    const std::uint32_t whole = instance.mesh;
    if (!lamps.empty() && lamps.size() == scene_.meshes[whole].geometries.size()) {
      instance.mask = kMaskEmissiveProxy;
      lamps.clear();
    }
    for (const std::size_t id : lamps) {
      Instance lamp = instance;
      lamp.mask = kMaskEmissiveProxy;
      lamp.mesh = only(whole, id);
      scene_.instances.push_back(std::move(lamp));
    }
    if (!lamps.empty()) instance.mesh = without(whole, lamps);
    scene_.instances.push_back(std::move(instance));
  }

  std::vector<std::size_t> lamps_of(const Instance& instance) const {
    std::vector<std::size_t> out;
    const Mesh& mesh = scene_.meshes[instance.mesh];
    for (std::size_t id = 0; id < mesh.geometries.size(); ++id) {
      const Geometry& geometry = mesh.geometries[id];
      if (!glows(scene_.materials[geometry.material].constants)) continue;
      const Bounds box = placed(mesh_of(mesh, geometry).bounds(), instance.transform);
      if (glm::length(box.size()) <= kLargestPart * size_ && holds_lamp(box, scene_)) {
        out.push_back(id);
      }
    }
    return out;
  }

  std::uint32_t add(Mesh mesh) {
    scene_.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene_.meshes.size() - 1);
  }

  std::uint32_t only(std::uint32_t whole, std::size_t id) {
    const auto [found, is_new] = lamps_.try_emplace({whole, id}, 0);
    if (is_new)
      found->second = add(mesh_of(scene_.meshes[whole], scene_.meshes[whole].geometries[id]));
    return found->second;
  }

  std::uint32_t without(std::uint32_t whole, const std::vector<std::size_t>& lamps) {
    const auto [found, is_new] = rests_.try_emplace({whole, lamps}, 0);
    if (!is_new) return found->second;
    Mesh rest = scene_.meshes[whole];
    for (auto id = lamps.rbegin(); id != lamps.rend(); ++id) {
      rest.geometries.erase(rest.geometries.begin() + static_cast<std::ptrdiff_t>(*id));
    }
    found->second = add(std::move(rest));
    return found->second;
  }

  Scene& scene_;
  double size_;  // metres, of the scene
  std::size_t count_ = 0;
  std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> lamps_;
  std::map<std::pair<std::uint32_t, std::vector<std::size_t>>, std::uint32_t> rests_;
};

}  // namespace

std::size_t separate_lamp_shapes(Scene& scene) {
  return Separation(scene).run();
}

}  // namespace kaamos::effects
