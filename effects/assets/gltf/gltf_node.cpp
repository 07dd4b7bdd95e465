// SPDX-License-Identifier: MIT
// Reads the node hierarchy of a glTF file: instances, lights and cameras with world transforms.
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "effects/assets/gltf/gltf_accessor.h"
#include "effects/assets/gltf/gltf_copies.h"
#include "effects/assets/gltf/gltf_reader.h"

namespace kaamos::effects {
namespace {

class NodeReader {
 public:
  explicit NodeReader(GltfReader& reader) : reader_(reader), model_(reader.model) {}
  Status run();

 private:
  Status roots(std::vector<int>& out) const;
  Status walk(const std::vector<int>& roots);
  Status local_transform(const tinygltf::Node& node, const std::string& where,
                         glm::dmat4& out) const;
  Status contents(std::size_t id);
  Status mesh(const tinygltf::Node& node, std::size_t id, const std::string& where,
              const glm::dmat4& world);
  Result<int> mesh_of(const tinygltf::Node& node, std::size_t id);
  std::span<const double> weights_of(const tinygltf::Node& node) const;
  Status instance(const tinygltf::Node& node, std::size_t id, const std::string& where,
                  const glm::dmat4& world, const GltfCopy& copy, std::uint32_t mesh);
  Status skinned(const tinygltf::Node& node, std::size_t id, const std::string& where,
                 std::uint32_t mesh);
  Status animated_skin(const tinygltf::Node& node, std::size_t id, const std::string& where,
                       std::uint32_t mesh, const std::vector<glm::dmat4>& inverse_binds);
  Status inverse_binds(const tinygltf::Skin& skin, const std::string& where,
                       std::vector<glm::dmat4>& out) const;
  void keep_nodes();
  Status joint_matrices(const tinygltf::Skin& skin, const std::string& where,
                        std::vector<glm::dmat4>& out) const;
  Status camera(const tinygltf::Node& node, const std::string& where, const glm::dmat4& world);
  Status light(std::size_t id, const std::string& where, const glm::dmat4& world);
  std::string where(std::size_t id) const { return gltf_part("node", id, model_.nodes[id].name); }

  GltfReader& reader_;
  const tinygltf::Model& model_;
  std::vector<glm::dmat4> world_;
  std::vector<bool> visited_;
  std::vector<std::size_t> order_;
  std::vector<bool> moves_;   // set if `animated`: the first animation moves the node or a parent
  std::vector<bool> morphs_;  // likewise: it moves the morph weights of the node
  std::vector<std::int32_t> skin_ids_;
  // In Scene::meshes, by the file's mesh, whether its weights move, and what they are at rest.
  std::map<std::tuple<int, bool, std::vector<double>>, int> morphed_;
};

Error id_error(const std::string& where, const char* noun, int id, std::size_t count) {
  return make_error(ErrorId::kGltf, where + ": names " + noun + " " + std::to_string(id) + " of " +
                                        std::to_string(count));
}

bool in_range(int id, std::size_t count) {
  return id >= 0 && static_cast<std::size_t>(id) < count;
}

/// The normalised axis, or `fallback` if its length is zero. A unit vector that was rounded to
/// float comes back as it is.
glm::dvec3 axis(const glm::dmat4& m, int column, const glm::dvec3& fallback) {
  const glm::dvec3 v(m[column]);
  const double length = glm::length(v);
  if (std::abs(length - 1.0) < 2e-7) return v;
  return length > 0.0 && std::isfinite(length) ? v / length : fallback;
}

Status NodeReader::roots(std::vector<int>& out) const {
  if (model_.defaultScene >= 0 || !model_.scenes.empty()) {
    const int id = std::max(0, model_.defaultScene);
    if (!in_range(id, model_.scenes.size()))
      return id_error("the file", "scene", id, model_.scenes.size());
    out = model_.scenes[static_cast<std::size_t>(id)].nodes;
    return {};
  }
  // Without a scene, everything is shown: all nodes that are no node's child.
  std::vector<bool> child(model_.nodes.size(), false);
  for (const tinygltf::Node& node : model_.nodes)
    for (const int id : node.children)
      if (in_range(id, child.size())) child[static_cast<std::size_t>(id)] = true;
  for (std::size_t id = 0; id < child.size(); ++id)
    if (!child[id]) out.push_back(static_cast<int>(id));
  return {};
}

Status NodeReader::local_transform(const tinygltf::Node& node, const std::string& where,
                                   glm::dmat4& out) const {
  const auto allowed = [](std::size_t size, std::size_t full) { return size == 0 || size == full; };
  if (!allowed(node.matrix.size(), 16) || !allowed(node.translation.size(), 3) ||
      !allowed(node.rotation.size(), 4) || !allowed(node.scale.size(), 3))
    return make_error(ErrorId::kGltf,
                      where +
                          ": matrix, translation, rotation or scale has the wrong number "
                          "of elements, 16, 3, 4 and 3 are allowed");
  glm::dmat4 m(1.0);
  if (!node.matrix.empty()) {
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    m[0][3] = m[1][3] = m[2][3] = 0.0;
    m[3][3] = 1.0;
  } else {
    if (!node.rotation.empty()) {
      const auto& r = node.rotation;
      const glm::dquat q(r[3], r[0], r[1], r[2]);
      const double length = glm::length(q);
      if (length > 0.0 && std::isfinite(length)) m = glm::mat4_cast(q / length);
    }
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = static_cast<std::size_t>(c);
      if (!node.scale.empty()) m[c] *= node.scale[i];
      if (!node.translation.empty()) m[3][c] = node.translation[i];
    }
  }
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(m[i / 4][i % 4]))
      return make_error(ErrorId::kGltf, where + ": its transform is not finite");
  out = m;
  return {};
}

/// Fills world_ and order_, parents first. It does not recurse, so that a deep chain cannot
/// overflow the stack.
Status NodeReader::walk(const std::vector<int>& start) {
  struct Step {
    int id;
    glm::dmat4 parent;
  };
  std::vector<Step> open;
  for (auto id = start.rbegin(); id != start.rend(); ++id) open.push_back({*id, glm::dmat4(1.0)});
  while (!open.empty()) {
    const Step step = open.back();
    open.pop_back();
    if (!in_range(step.id, model_.nodes.size()))
      return id_error("the node hierarchy", "node", step.id, model_.nodes.size());
    const std::size_t id = static_cast<std::size_t>(step.id);
    if (visited_[id])
      return make_error(ErrorId::kGltf,
                        where(id) +
                            ": is reached twice; a node has one parent at most and no "
                            "cycles are allowed");
    visited_[id] = true;
    glm::dmat4 local(1.0);
    const Status status = local_transform(model_.nodes[id], where(id), local);
    if (!status.ok()) return status;
    world_[id] = step.parent * local;
    order_.push_back(id);
    const std::vector<int>& children = model_.nodes[id].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      open.push_back({*child, world_[id]});
  }
  return {};
}

/// A rotation and an offset, nothing else.
bool is_rigid(const glm::dmat4& m) {
  const glm::dmat3 rotation(m);
  const glm::dmat3 product = glm::transpose(rotation) * rotation;
  double worst = 0.0;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) worst = std::max(worst, std::abs(product[c][r] - (c == r)));
  return worst < 1e-9 && glm::determinant(rotation) > 0.0;
}

/// Glass gets a mask of its own, so that shadow and occlusion rays miss it. What is unlit neither
/// gives light nor takes it away, as pictures of lamps do.
std::uint8_t mask_of(const Scene& scene, const Mesh& mesh) {
  bool glass = true, unlit = true;
  for (const Geometry& geometry : mesh.geometries) {
    const std::uint32_t flags = scene.materials[geometry.material].constants.flags;
    glass &= (flags & kMaterialBlend) && !(flags & kMaterialAlphaTested);
    unlit &= (flags & kMaterialUnlit) != 0;
  }
  if (glass) return kMaskTransparent;
  return unlit ? kMaskEmissiveProxy : kMaskOpaque;
}

/// Morph weights of a node: its own, or those of its mesh. [glTF 2.0: Morph Targets]
std::span<const double> NodeReader::weights_of(const tinygltf::Node& node) const {
  return node.weights.empty() ? model_.meshes[static_cast<std::size_t>(node.mesh)].weights
                              : node.weights;
}

/// The mesh of a node in Scene::meshes, or -1 if it has no triangles. A node with morph weights of
/// its own, or whose weights move, gets a mesh of its own.
Result<int> NodeReader::mesh_of(const tinygltf::Node& node, std::size_t node_id) {
  const auto place = static_cast<std::size_t>(node.mesh);
  const int id = reader_.mesh_ids[place];
  const tinygltf::Mesh& from = model_.meshes[place];
  if (id < 0 || count_morph_targets(from) == 0) return id;
  const bool morphs = reader_.animated && morphs_[node_id];
  if (!morphs && (node.weights.empty() || node.weights == from.weights)) return id;
  const std::span<const double> weights = weights_of(node);
  const auto [found, is_new] = morphed_.try_emplace(
      {node.mesh, morphs, std::vector<double>(weights.begin(), weights.end())}, id);
  if (!is_new) return found->second;
  Result<Mesh> mesh = morphs ? read_morphable_mesh(reader_, node.mesh, weights)
                             : read_morphed_mesh(reader_, node.mesh, weights);
  if (!mesh.ok()) return mesh.error();
  mesh.value().name += morphs ? " (morphs)" : " (morphed)";
  found->second = static_cast<int>(reader_.scene.meshes.size());
  reader_.scene.meshes.push_back(std::move(mesh.value()));
  return found->second;
}

Status NodeReader::mesh(const tinygltf::Node& node, std::size_t node_id, const std::string& where,
                        const glm::dmat4& world) {
  if (!in_range(node.mesh, model_.meshes.size()))
    return id_error(where, "mesh", node.mesh, model_.meshes.size());
  const Result<int> mesh = mesh_of(node, node_id);
  if (!mesh.ok()) return mesh.error();
  if (mesh.value() < 0) return {};
  const auto id = static_cast<std::uint32_t>(mesh.value());
  const Result<std::vector<GltfCopy>> copies = read_gltf_copies(reader_, node, where);
  if (!copies.ok()) return copies.error();
  if (node.skin >= 0) {
    if (!copies.value().empty())
      reader_.warn(where +
                   ": EXT_mesh_gpu_instancing of a skinned mesh is left out; it stands once");
    return skinned(node, node_id, where, id);
  }
  const std::string name = node.name.empty() ? where : node.name;
  if (copies.value().empty()) return instance(node, node_id, where, world, {name}, id);
  for (const GltfCopy& copy : copies.value()) {
    const Status status = instance(node, node_id, where, world, copy, id);
    if (!status.ok()) return status;
  }
  return {};
}

Status NodeReader::instance(const tinygltf::Node& node, std::size_t node_id,
                            const std::string& where, const glm::dmat4& world, const GltfCopy& copy,
                            std::uint32_t mesh) {
  Instance instance;
  instance.name = copy.name;
  instance.mesh = mesh;
  instance.transform = copy.transform ? world * *copy.transform : world;
  instance.mask = read_instance_mask(node.extras, where, reader_.warnings)
                      .value_or(mask_of(reader_.scene, reader_.scene.meshes[mesh]));
  const double determinant = glm::determinant(glm::dmat3(instance.transform));
  if (determinant == 0.0 || !std::isfinite(determinant)) {
    reader_.warn(where + ": its transform is singular; the instance is left out");
    if (reader_.singular.empty()) reader_.singular = where;
    return {};
  }
  if (reader_.animated && moves_[node_id]) {
    instance.transform = glm::dmat4(1.0);
    instance.motion.node = reader_.node_ids[node_id];
    instance.motion.animation = 0;
    if (copy.transform) {  // a node of its own below the one that moves
      Node below;
      below.name = copy.name;
      below.parent = instance.motion.node;
      below.matrix = copy.transform;
      instance.motion.node = static_cast<std::int32_t>(reader_.scene.nodes.size());
      reader_.scene.nodes.push_back(std::move(below));
    }
  }
  if (reader_.scene.meshes[mesh].morph_targets > 0) {
    instance.motion.morph = reader_.node_ids[node_id];
    instance.motion.animation = 0;
    instance.build_class = BuildClass::kHero;
    if (node.extensions.contains("MSFT_lod"))
      reader_.warn(where + ", MSFT_lod: its morph weights move; its levels of detail are left out");
  } else {
    const Status levels = read_gltf_levels(reader_, node, where, instance);
    if (!levels.ok()) return levels;
  }
  reader_.scene.instances.push_back(std::move(instance));
  return {};
}

Status NodeReader::inverse_binds(const tinygltf::Skin& skin, const std::string& where,
                                 std::vector<glm::dmat4>& out) const {
  std::vector<float> inverse;
  if (skin.inverseBindMatrices >= 0) {
    Result<std::vector<float>> read =
        read_floats(model_, skin.inverseBindMatrices, 16, where + ", inverse bind matrices");
    if (!read.ok()) return read.error();
    inverse = std::move(read.value());
    if (inverse.size() < skin.joints.size() * 16)
      return make_error(ErrorId::kGltf, where + ": has " + std::to_string(skin.joints.size()) +
                                            " joints and " + std::to_string(inverse.size() / 16) +
                                            " inverse bind matrices");
  }
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    if (!in_range(skin.joints[j], model_.nodes.size()))
      return id_error(where, "joint node", skin.joints[j], model_.nodes.size());
    glm::dmat4 bind(1.0);
    if (!inverse.empty())
      for (int i = 0; i < 16; ++i)
        bind[i / 4][i % 4] = static_cast<double>(inverse[16 * j + static_cast<std::size_t>(i)]);
    out.push_back(bind);
  }
  return {};
}

// Keeps the nodes of the scene, parents first, and finds out which of them the first animation
// moves.
void NodeReader::keep_nodes() {
  reader_.node_ids.assign(model_.nodes.size(), kNoIndex);
  moves_.assign(model_.nodes.size(), false);
  morphs_.assign(model_.nodes.size(), false);
  if (!model_.animations.empty()) {
    for (const tinygltf::AnimationChannel& channel : model_.animations.front().channels) {
      if (!in_range(channel.target_node, moves_.size())) continue;
      auto& moves = channel.target_path == "weights" ? morphs_ : moves_;
      moves[static_cast<std::size_t>(channel.target_node)] = true;
    }
  }
  for (std::size_t i = 0; i < order_.size(); ++i)
    reader_.node_ids[order_[i]] = static_cast<std::int32_t>(i);
  reader_.scene.nodes.resize(order_.size());
  for (const std::size_t id : order_) {
    const tinygltf::Node& from = model_.nodes[id];
    Node& to = reader_.scene.nodes[static_cast<std::size_t>(reader_.node_ids[id])];
    to.name = from.name.empty() ? where(id) : from.name;
    if (in_range(from.mesh, model_.meshes.size())) {
      const auto& mesh = model_.meshes[static_cast<std::size_t>(from.mesh)];
      const std::span<const double> weights = weights_of(from);
      to.weights.assign(count_morph_targets(mesh), 0.0f);
      for (std::size_t t = 0; t < std::min(weights.size(), to.weights.size()); ++t)
        to.weights[t] = static_cast<float>(weights[t]);
    }
    if (!from.matrix.empty()) {
      // local_transform has checked it already.
      if (local_transform(from, to.name, to.matrix.emplace(1.0)).ok()) moves_[id] = false;
    } else {
      for (int c = 0; c < 3; ++c) {
        const std::size_t k = static_cast<std::size_t>(c);
        if (!from.translation.empty()) to.translation[c] = from.translation[k];
        if (!from.scale.empty()) to.scale[c] = from.scale[k];
      }
      if (!from.rotation.empty()) {
        const auto& r = from.rotation;
        const glm::dquat q(r[3], r[0], r[1], r[2]);
        const double length = glm::length(q);
        if (length > 0.0 && std::isfinite(length)) to.rotation = q / length;
      }
    }
  }
  for (const std::size_t id : order_) {
    for (const int child : model_.nodes[id].children) {
      const std::size_t below = static_cast<std::size_t>(child);
      reader_.scene.nodes[static_cast<std::size_t>(reader_.node_ids[below])].parent =
          reader_.node_ids[id];
      if (moves_[id]) moves_[below] = true;
    }
  }
}

// The instance keeps its skin, and the mesh stays in its bind pose.
Status NodeReader::animated_skin(const tinygltf::Node& node, std::size_t node_id,
                                 const std::string& where, std::uint32_t mesh,
                                 const std::vector<glm::dmat4>& binds) {
  const tinygltf::Skin& from = model_.skins[static_cast<std::size_t>(node.skin)];
  Scene& scene = reader_.scene;
  std::int32_t& id = skin_ids_[static_cast<std::size_t>(node.skin)];
  if (id == kNoIndex) {
    id = static_cast<std::int32_t>(scene.skins.size());
    Skin skin;
    skin.name = from.name.empty() ? "skin " + std::to_string(node.skin) : from.name;
    skin.inverse_binds = binds;
    for (const int joint : from.joints) {
      std::int32_t& to = reader_.node_ids[static_cast<std::size_t>(joint)];
      // A joint outside the shown scene does not move.
      if (to == kNoIndex) {
        to = static_cast<std::int32_t>(scene.nodes.size());
        scene.nodes.emplace_back().name = "joint " + std::to_string(joint);
      }
      skin.joints.push_back(static_cast<std::uint32_t>(to));
    }
    scene.skins.push_back(std::move(skin));
  }
  Instance instance;
  instance.name = node.name.empty() ? where : node.name;
  instance.mesh = mesh;
  instance.mask = mask_of(scene, scene.meshes[instance.mesh]);
  instance.motion.skin = id;
  if (scene.meshes[mesh].morph_targets > 0) instance.motion.morph = reader_.node_ids[node_id];
  if (!model_.animations.empty()) instance.motion.animation = 0;
  instance.build_class = BuildClass::kHero;
  for (const SkinVertex& v : scene.meshes[instance.mesh].skin) {
    for (int k = 0; k < 4; ++k) {
      if (v.joints[k] >= from.joints.size())
        return make_error(ErrorId::kGltf, where + ", JOINTS_0: names joint " +
                                              std::to_string(v.joints[k]) + " of " +
                                              std::to_string(from.joints.size()));
    }
  }
  scene.instances.push_back(std::move(instance));
  return {};
}

Status NodeReader::skinned(const tinygltf::Node& node, std::size_t node_id,
                           const std::string& where, std::uint32_t mesh) {
  if (!in_range(node.skin, model_.skins.size()))
    return id_error(where, "skin", node.skin, model_.skins.size());
  const tinygltf::Skin& skin = model_.skins[static_cast<std::size_t>(node.skin)];
  std::vector<glm::dmat4> joints;
  const Status status = inverse_binds(skin, where + ", skin " + std::to_string(node.skin), joints);
  if (!status.ok()) return status;
  if (reader_.animated) {
    const Mesh& bind = reader_.scene.meshes[mesh];
    if (!joints.empty() && bind.skin.size() == bind.vertices.size())
      return animated_skin(node, node_id, where, mesh, joints);
    reader_.warn(where +
                 ": its mesh has primitives without joints and weights; it stays in the "
                 "pose of the file");
  }
  for (std::size_t j = 0; j < joints.size(); ++j)
    joints[j] = world_[static_cast<std::size_t>(skin.joints[j])] * joints[j];
  Result<Mesh> posed = read_skinned_mesh(reader_, node.mesh, weights_of(node), joints);
  if (!posed.ok()) return posed.error();
  Instance instance;
  instance.name = node.name.empty() ? where : node.name;
  instance.mesh = static_cast<std::uint32_t>(reader_.scene.meshes.size());
  instance.mask = mask_of(reader_.scene, posed.value());
  posed.value().name += " (posed)";
  reader_.scene.meshes.push_back(std::move(posed.value()));
  reader_.scene.instances.push_back(std::move(instance));
  return {};
}

Status NodeReader::camera(const tinygltf::Node& node, const std::string& where,
                          const glm::dmat4& world) {
  if (!in_range(node.camera, model_.cameras.size()))
    return id_error(where, "camera", node.camera, model_.cameras.size());
  const tinygltf::Camera& from = model_.cameras[static_cast<std::size_t>(node.camera)];
  const bool is_orthographic = from.type == "orthographic";
  // Mirrored pictures, which a negative number asks for, are no part of glTF.
  const double half_height = from.orthographic.ymag;
  if (is_orthographic && !(half_height > 0.0 && std::isfinite(half_height))) {
    reader_.warn(where + ": the ymag of its orthographic camera is not above 0; it is left out");
    return {};
  }
  const double fov = from.perspective.yfov;
  if (!is_orthographic && (from.type != "perspective" || !(fov > 0.0) || !(fov < 3.14159))) {
    reader_.warn(where +
                 ": its camera is not perspective with a field of view of 0..pi and is "
                 "left out");
    return {};
  }
  Camera to;
  to.name = from.name.empty() ? node.name : from.name;
  if (is_orthographic) {
    to.half_height = half_height;
  } else {
    to.vertical_fov = fov;
  }
  const double near = is_orthographic ? from.orthographic.znear : from.perspective.znear;
  if (near > 0.0 && std::isfinite(near)) to.near_plane = near;
  // Rebuild the view from eye and direction, so that scale and shear of the parents do not affect
  // it.
  const glm::dvec3 eye(world[3]);
  to.camera_to_world =
      is_rigid(world) ? world
                      : look_at(eye, eye - axis(world, 2, {0, 0, 1}), axis(world, 1, {0, 1, 0}));
  reader_.scene.cameras.push_back(to);
  return {};
}

Status NodeReader::light(std::size_t id, const std::string& where, const glm::dmat4& world) {
  const tinygltf::Node& node = model_.nodes[id];
  const auto found = node.extensions.find("KHR_lights_punctual");
  if (found == node.extensions.end() || !found->second.Has("light") ||
      !found->second.Get("light").IsNumber())
    return {};
  const int light_id = found->second.Get("light").GetNumberAsInt();
  if (!in_range(light_id, model_.lights.size()))
    return id_error(where, "light", light_id, model_.lights.size());
  const tinygltf::Light& from = model_.lights[static_cast<std::size_t>(light_id)];
  Light to;
  to.name = from.name.empty() ? node.name : from.name;
  if (from.type == "directional") {
    to.type = LightType::kDirectional;
  } else if (from.type == "spot") {
    to.type = LightType::kSpot;
  } else if (from.type != "point") {
    return make_error(ErrorId::kGltf, where + ", light " + std::to_string(light_id) +
                                          ": type is \"" + from.type +
                                          "\", directional, point and spot are allowed");
  }
  for (int i = 0; i < 3 && static_cast<std::size_t>(i) < from.color.size(); ++i)
    to.color[i] = std::max(0.0f, static_cast<float>(from.color[static_cast<std::size_t>(i)]));
  to.intensity = std::isfinite(from.intensity) && from.intensity >= 0.0
                     ? static_cast<float>(from.intensity)
                     : 1.0f;
  to.range = static_cast<float>(std::max(0.0, from.range));
  to.outer_cone_angle = static_cast<float>(std::clamp(from.spot.outerConeAngle, 0.0, 1.5707963));
  to.inner_cone_angle =
      std::clamp(static_cast<float>(from.spot.innerConeAngle), 0.0f, to.outer_cone_angle);
  to.position = glm::dvec3(world[3]);
  to.direction = glm::vec3(-axis(world, 2, {0, 0, 1}));
  read_lamp_extras(node.extras, where, to, reader_.warnings);
  if (const auto slide = reader_.slides.find(id); slide != reader_.slides.end()) {
    if (to.type == LightType::kSpot)
      to.projection = slide->second;
    else
      reader_.warn(where + ", extras: projection is of a light that is no spot; it is left out");
  }
  if (to.type == LightType::kDirectional && !reader_.sun) {
    if (const auto sun = read_sun_extras(node.extras, where, reader_.warnings))
      reader_.sun = {reader_.scene.lights.size(), *sun};
  }
  reader_.scene.lights.push_back(to);
  return {};
}

Status NodeReader::contents(std::size_t id) {
  const tinygltf::Node& node = model_.nodes[id];
  const std::string place = where(id);
  Status status;
  if (node.mesh >= 0) status = mesh(node, id, place, world_[id]);
  if (status.ok() && node.camera >= 0) status = camera(node, place, world_[id]);
  if (status.ok()) status = light(id, place, world_[id]);
  return status;
}

Status NodeReader::run() {
  world_.assign(model_.nodes.size(), glm::dmat4(1.0));
  visited_.assign(model_.nodes.size(), false);
  std::vector<int> start;
  Status status = roots(start);
  if (status.ok()) status = walk(start);
  skin_ids_.assign(model_.skins.size(), kNoIndex);
  if (status.ok() && reader_.animated) keep_nodes();
  for (std::size_t i = 0; status.ok() && i < order_.size(); ++i) status = contents(order_[i]);
  return status;
}

}  // namespace

Status read_gltf_nodes(GltfReader& reader) {
  return NodeReader(reader).run();
}

}  // namespace kaamos::effects
