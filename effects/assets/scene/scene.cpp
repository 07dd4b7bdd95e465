// SPDX-License-Identifier: MIT
#include "effects/assets/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace kaamos::effects {
namespace {

bool finite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

bool unit(const glm::vec3& v) {
  return std::abs(glm::dot(v, v) - 1.0f) < 1e-3f;
}

}  // namespace

glm::vec3 sky_radiance(const Sky& sky, const glm::vec3& direction) {
  if (direction.y >= 0.0f) {
    // The square root keeps the bright band at the horizon narrow, as in a real sky.
    return glm::mix(sky.horizon, sky.zenith, std::sqrt(std::min(direction.y, 1.0f)));
  }
  return glm::mix(sky.horizon, sky.ground, std::min(1.0f, -direction.y * 8.0f));
}

glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
  glm::dvec3 back = eye - target;
  const double distance = glm::length(back);
  back = distance > 0.0 ? back / distance : glm::dvec3(0, 0, 1);
  glm::dvec3 right = glm::cross(up, back);
  if (glm::length(right) < 1e-9) {
    // The view direction is along `up`, so any other axis may define the right of the picture.
    right = glm::cross(std::abs(back.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1), back);
  }
  right = glm::normalize(right);
  const glm::dvec3 true_up = glm::cross(back, right);
  return glm::dmat4(glm::dvec4(right, 0), glm::dvec4(true_up, 0), glm::dvec4(back, 0),
                    glm::dvec4(eye, 1));
}

glm::mat3x4 transform_3x4(const Instance& instance, const glm::dvec3& origin) {
  glm::dmat4 m = instance.transform;
  m[3] -= glm::dvec4(origin, 0.0);
  // glm's mat3x4 has three columns of four elements; its columns are the rows that we need.
  return glm::mat3x4(glm::transpose(m));
}

bool is_baked(const Instance& instance) {
  constexpr unsigned kUnseen = kMaskTransparent | kMaskEmissiveProxy | kMaskBaked;
  return (instance.mask & ~kUnseen) != 0 && instance.motion == Motion{};
}

std::uint8_t instance_mask(const Instance& instance) {
  const unsigned own = instance.mask & ~unsigned{kMaskBaked};
  return static_cast<std::uint8_t>(is_baked(instance) ? own | kMaskBaked : own);
}

bool is_mirrored(const Instance& instance) {
  return glm::determinant(glm::dmat3(instance.transform)) < 0.0;
}

std::uint64_t instanced_triangle_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Instance& instance : scene.instances)
    count += scene.meshes[instance.mesh].triangle_count();
  return count;
}

std::uint64_t unique_triangle_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += mesh.triangle_count();
  return count;
}

Bounds scene_bounds(const Scene& scene) {
  std::vector<Bounds> boxes;
  for (const Mesh& mesh : scene.meshes) boxes.push_back(mesh.bounds());
  Bounds all;
  const std::vector<InstanceState> states = evaluate_instances(scene, 0.0);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Instance& instance = scene.instances[i];
    Bounds box = boxes[instance.mesh];
    if (states[i].is_deformed()) {
      box = Bounds();
      for (const Vertex& v : deform_vertices(scene.meshes[instance.mesh], states[i]))
        box.add(glm::dvec3(v.position));
    }
    if (box.empty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec4 p((corner & 1) ? box.max.x : box.min.x, (corner & 2) ? box.max.y : box.min.y,
                         (corner & 4) ? box.max.z : box.min.z, 1.0);
      all.add(glm::dvec3(states[i].transform * p));
    }
  }
  return all;
}

namespace {

/// Keeps track of where a check is, so that each message names the place.
class Checker {
 public:
  explicit Checker(const Scene& scene) : scene_(scene) {}
  Status run();

 private:
  void mesh(const Mesh& mesh);
  void geometry(const Mesh& mesh, const Geometry& geometry, const std::string& where);
  void material(const Material& material);
  void image(const TextureImage& image);
  void instance(const Instance& instance);
  void motion(const Instance& instance, const std::string& where);
  void animation(const Animation& animation);
  void skeleton();
  void light(const Light& light);
  void rest();
  void require(bool rule, const std::string& where, const std::string& what) {
    if (!rule && first_.empty()) first_ = where + ": " + what;
  }

  const Scene& scene_;
  std::string first_;
};

std::string quoted(const char* noun, const std::string& name) {
  return std::string(noun) + " \"" + name + "\"";
}

void Checker::geometry(const Mesh& mesh, const Geometry& g, const std::string& where) {
  require(g.index_size_bytes == 2 || g.index_size_bytes == 4, where,
          "index size is " + std::to_string(g.index_size_bytes) + " bytes, 2 or 4 are allowed");
  require(g.index_offset_bytes % 16 == 0, where, "index offset is not a multiple of 16 bytes");
  require(g.index_count % 3 == 0, where, "index count is not a multiple of 3");
  const std::uint64_t end =
      g.index_offset_bytes + std::uint64_t{g.index_count} * g.index_size_bytes;
  require(
      (end + 3) / 4 * 4 <= mesh.indices.size(), where,
      "indices end at byte " + std::to_string(end) + " of " + std::to_string(mesh.indices.size()));
  require(std::uint64_t{g.first_vertex} + g.vertex_count <= mesh.vertices.size(), where,
          "vertices end at " + std::to_string(std::uint64_t{g.first_vertex} + g.vertex_count) +
              " of " + std::to_string(mesh.vertices.size()));
  require(
      g.material < scene_.materials.size(), where,
      "material " + std::to_string(g.material) + " of " + std::to_string(scene_.materials.size()));
  if (!first_.empty()) return;
  for (std::uint32_t i = 0; i < g.index_count; ++i) {
    const std::uint32_t index = mesh.index(g, i);
    if (index >= g.vertex_count)
      return require(false, where,
                     "index " + std::to_string(i) + " is " + std::to_string(index) +
                         ", the geometry has " + std::to_string(g.vertex_count) + " vertices");
  }
}

void Checker::mesh(const Mesh& mesh) {
  const std::string where = quoted("mesh", mesh.name);
  require(!mesh.geometries.empty(), where, "has no geometry");
  require(mesh.skin.empty() || mesh.skin.size() == mesh.vertices.size(), where,
          std::to_string(mesh.skin.size()) + " skinned vertices of " +
              std::to_string(mesh.vertices.size()));
  require(mesh.colors.empty() || mesh.colors.size() == mesh.vertices.size(), where,
          std::to_string(mesh.colors.size()) + " coloured vertices of " +
              std::to_string(mesh.vertices.size()));
  require(mesh.second_uv.empty() || mesh.second_uv.size() == mesh.vertices.size(), where,
          std::to_string(mesh.second_uv.size()) + " second texture coordinates of " +
              std::to_string(mesh.vertices.size()));
  require(mesh.morph.size() == mesh.vertices.size() * mesh.morph_targets, where,
          std::to_string(mesh.morph.size()) + " moves of morph targets, " +
              std::to_string(mesh.vertices.size() * mesh.morph_targets) + " expected");
  for (std::size_t i = 0; i < mesh.geometries.size(); ++i)
    geometry(mesh, mesh.geometries[i], where + ", geometry " + std::to_string(i));
}

void Checker::material(const Material& material) {
  const std::string where = quoted("material", material.name);
  for (std::uint32_t slot = 0; slot < kTextureSlotCount; ++slot) {
    const std::int32_t id = material.constants.image[slot];
    require(id == kNoTexture || (id >= 0 && static_cast<std::size_t>(id) < scene_.images.size()),
            where, "image " + std::to_string(id) + " of " + std::to_string(scene_.images.size()));
    require(material.constants.sampler[slot] < scene_.samplers.size(), where,
            "sampler " + std::to_string(material.constants.sampler[slot]) + " of " +
                std::to_string(scene_.samplers.size()));
  }
}

void Checker::image(const TextureImage& image) {
  const std::string where = quoted("image", image.name);
  require(image.width > 0 && image.height > 0 && !image.mips.empty(), where, "is empty");
  for (std::size_t level = 0; level < image.mips.size(); ++level) {
    const std::size_t wanted =
        std::size_t{std::max(1u, image.width >> level)} * std::max(1u, image.height >> level) * 4;
    require(image.mips[level].size() == wanted, where,
            "mip " + std::to_string(level) + " has " + std::to_string(image.mips[level].size()) +
                " bytes, " + std::to_string(wanted) + " expected");
  }
}

void Checker::instance(const Instance& instance) {
  const std::string where = quoted("instance", instance.name);
  require(instance.mesh < scene_.meshes.size(), where,
          "mesh " + std::to_string(instance.mesh) + " of " + std::to_string(scene_.meshes.size()));
  bool shown = instance.levels.empty();
  for (const Level& level : instance.levels) {
    require(level.mesh < scene_.meshes.size(), where,
            "level of detail: mesh " + std::to_string(level.mesh) + " of " +
                std::to_string(scene_.meshes.size()));
    shown = shown || level.mesh == instance.mesh;
  }
  require(shown, where, "its mesh is none of its levels of detail");
  require(instance.levels.empty() ||
              (instance.motion.skin == kNoIndex && instance.motion.morph == kNoIndex),
          where, "has levels of detail and a skin or morph targets; one of them is allowed");
  require(finite(instance.transform), where, "transform is not finite");
  const glm::dmat4& m = instance.transform;
  require(m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] == 1.0, where,
          "transform is not affine");
  motion(instance, where);
}

std::string of(std::int64_t id, std::size_t count) {
  return std::to_string(id) + " of " + std::to_string(count);
}

void Checker::motion(const Instance& instance, const std::string& where) {
  const Motion& m = instance.motion;
  const auto in_range = [](std::int32_t id, std::size_t count) {
    return id == kNoIndex || (id >= 0 && static_cast<std::size_t>(id) < count);
  };
  require(in_range(m.skin, scene_.skins.size()), where, "skin " + of(m.skin, scene_.skins.size()));
  require(in_range(m.animation, scene_.animations.size()), where,
          "animation " + of(m.animation, scene_.animations.size()));
  require(in_range(m.node, scene_.nodes.size()), where, "node " + of(m.node, scene_.nodes.size()));
  require(std::isfinite(m.start), where, "its animation's start is not finite");
  require(in_range(m.morph, scene_.nodes.size()), where,
          "node " + of(m.morph, scene_.nodes.size()));
  if (first_.empty() && m.morph != kNoIndex) {
    const std::size_t weights = scene_.nodes[static_cast<std::size_t>(m.morph)].weights.size();
    const std::uint32_t targets = scene_.meshes[instance.mesh].morph_targets;
    require(targets > 0 && weights == targets, where,
            "its node has " + std::to_string(weights) + " weights, its mesh " +
                std::to_string(targets) + " morph targets");
  }
  if (!first_.empty() || m.skin == kNoIndex) return;
  const Mesh& mesh = scene_.meshes[instance.mesh];
  require(!mesh.skin.empty(), where, "has a skin, and its mesh has no joints and weights");
  const std::size_t joints = scene_.skins[static_cast<std::size_t>(m.skin)].joints.size();
  for (const SkinVertex& v : mesh.skin) {
    for (int k = 0; k < 4; ++k) {
      if (v.joints[k] >= joints) return require(false, where, "joint " + of(v.joints[k], joints));
    }
  }
}

void Checker::animation(const Animation& animation) {
  const std::string where = quoted("animation", animation.name);
  require(std::isfinite(animation.duration) && animation.duration >= 0, where,
          "duration is not finite or negative");
  for (const Channel& channel : animation.channels) {
    require(channel.node < scene_.nodes.size(), where,
            "node " + of(channel.node, scene_.nodes.size()));
    std::size_t per_key = channel.interpolation == Interpolation::kCubicSpline ? 3 : 1;
    const bool is_morph = channel.path == ChannelPath::kWeights;
    if (is_morph && channel.node < scene_.nodes.size())
      per_key *= scene_.nodes[channel.node].weights.size();
    const std::size_t values = is_morph ? channel.weights.size() : channel.values.size();
    require(!channel.times.empty() && values == per_key * channel.times.size(), where,
            "a channel has " + std::to_string(channel.times.size()) + " times and " +
                std::to_string(values) + " values, " + std::to_string(per_key) +
                " per time expected");
    for (const float weight : channel.weights)
      require(std::isfinite(weight), where, "a value of a channel is not finite");
    for (std::size_t i = 0; i < channel.times.size(); ++i) {
      require(
          std::isfinite(channel.times[i]) && (i == 0 || channel.times[i] > channel.times[i - 1]),
          where, "the times of a channel do not rise");
    }
    for (const glm::vec4& value : channel.values) {
      require(std::isfinite(value.x + value.y + value.z + value.w), where,
              "a value of a channel is not finite");
    }
  }
}

void Checker::skeleton() {
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    const Node& node = scene_.nodes[i];
    const std::string where = quoted("node", node.name);
    require(
        node.parent == kNoIndex || (node.parent >= 0 && static_cast<std::size_t>(node.parent) < i),
        where, "its parent " + std::to_string(node.parent) + " does not stand before it");
    require(!node.matrix || finite(*node.matrix), where, "transform is not finite");
  }
  for (const Skin& skin : scene_.skins) {
    const std::string where = quoted("skin", skin.name);
    require(skin.joints.size() == skin.inverse_binds.size(), where,
            std::to_string(skin.joints.size()) + " joints and " +
                std::to_string(skin.inverse_binds.size()) + " inverse bind matrices");
    for (const std::uint32_t joint : skin.joints) {
      require(joint < scene_.nodes.size(), where, "node " + of(joint, scene_.nodes.size()));
    }
    for (const glm::dmat4& bind : skin.inverse_binds) {
      require(finite(bind), where, "an inverse bind matrix is not finite");
    }
  }
}

void Checker::light(const Light& light) {
  const std::string where = quoted("light", light.name);
  require(unit(light.direction), where, "direction is not a unit vector");
  if (!light.projection) return;
  const ProjectionMap& map = *light.projection;
  require(light.type == LightType::kSpot, where, "has a projection map and is no spot");
  require(map.image < scene_.images.size(), where,
          "projection map: image " + of(map.image, scene_.images.size()));
  require(map.sampler < scene_.samplers.size(), where,
          "projection map: sampler " + of(map.sampler, scene_.samplers.size()));
  require(std::isfinite(map.up.x + map.up.y + map.up.z), where, "projection map: up is not finite");
}

void Checker::rest() {
  require(!scene_.materials.empty(), "scene", "has no material");
  require(!scene_.samplers.empty(), "scene", "has no sampler");
  require(!scene_.cameras.empty(), "scene", "has no camera");
  for (const Camera& camera : scene_.cameras) {
    const std::string where = quoted("camera", camera.name);
    require(finite(camera.camera_to_world), where, "transform is not finite");
    require(std::isfinite(camera.half_height) && camera.half_height >= 0.0, where,
            "half_height is " + std::to_string(camera.half_height) + ", 0 or above is allowed");
    require(camera.vertical_fov > 0.0 && camera.vertical_fov < 3.14159, where,
            "field of view is " + std::to_string(camera.vertical_fov) + ", 0..pi is allowed");
  }
  for (const Light& light : scene_.lights) this->light(light);
  for (std::size_t i = 0; i < scene_.particles.size(); ++i) {
    const Particle& particle = scene_.particles[i];
    const std::string where = "particle " + std::to_string(i);
    const glm::dvec3 sum = particle.position + glm::dvec3(particle.radiance);
    require(std::isfinite(sum.x + sum.y + sum.z) && particle.radius > 0.0f &&
                std::isfinite(particle.radius),
            where, "position or radiance is not finite, or radius is not above 0");
    require(particle.opacity >= 0.0f && particle.opacity <= 1.0f, where,
            "opacity is " + std::to_string(particle.opacity) + ", 0..1 is allowed");
  }
  if (scene_.sun)
    require(unit(scene_.sun->direction_to_sun) && scene_.sun->angular_radius >= 0.0f, "sun",
            "direction is not a unit vector or angular radius is negative");
}

Status Checker::run() {
  for (const Mesh& item : scene_.meshes) mesh(item);
  for (const Material& item : scene_.materials) material(item);
  for (const TextureImage& item : scene_.images) image(item);
  skeleton();
  for (const Animation& item : scene_.animations) animation(item);
  for (const Instance& item : scene_.instances) instance(item);
  rest();
  return first_.empty() ? Status()
                        : make_error(ErrorId::kScene, "scene \"" + scene_.name + "\": " + first_);
}

}  // namespace

Status validate(const Scene& scene) {
  return Checker(scene).run();
}

}  // namespace kaamos::effects
