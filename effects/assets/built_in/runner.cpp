// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/runner.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/shapes.h"
#include "effects/assets/scene/staging.h"
#include "effects/assets/scene/tangents.h"

namespace kaamos::effects {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr int kKeys = 128;       // keyframes of the circle
constexpr double kSteps = 8.0;   // double steps in the circle
constexpr double kCircle = 1.4;  // radius in metres

// The figure faces +Z, and +X is its left. Metres.
struct Bone {
  const char* name;
  int parent;
  glm::dvec3 offset;  // from the parent's joint
  glm::dvec3 tail;    // from its own joint
  double radius;      // 0: the bone has no capsule
};

constexpr int kHips = 0, kSpine = 1, kChest = 2, kHead = 4, kCape = 19;

const Bone kBones[kRunnerBones] = {
    {"hips", -1, {0, 0.95, 0}, {0, 0.12, 0}, 0.13},
    {"spine", 0, {0, 0.12, 0}, {0, 0.18, 0}, 0.12},
    {"chest", 1, {0, 0.18, 0}, {0, 0.2, 0}, 0.14},
    {"neck", 2, {0, 0.24, 0}, {0, 0.1, 0}, 0.05},
    {"head", 3, {0, 0.14, 0}, {0, 0.14, 0}, 0.1},
    {"left upper arm", 2, {0.2, 0.17, 0}, {0, -0.28, 0}, 0.048},
    {"left forearm", 5, {0, -0.28, 0}, {0, -0.25, 0}, 0.04},
    {"left hand", 6, {0, -0.25, 0}, {0, -0.1, 0}, 0.042},
    {"right upper arm", 2, {-0.2, 0.17, 0}, {0, -0.28, 0}, 0.048},
    {"right forearm", 8, {0, -0.28, 0}, {0, -0.25, 0}, 0.04},
    {"right hand", 9, {0, -0.25, 0}, {0, -0.1, 0}, 0.042},
    {"left thigh", 0, {0.1, -0.03, 0}, {0, -0.42, 0}, 0.078},
    {"left shin", 11, {0, -0.42, 0}, {0, -0.4, 0}, 0.058},
    {"left foot", 12, {0, -0.41, 0.02}, {0, -0.03, 0.12}, 0.046},
    {"left toe", 13, {0, -0.03, 0.12}, {0, 0, 0.06}, 0.036},
    {"right thigh", 0, {-0.1, -0.03, 0}, {0, -0.42, 0}, 0.078},
    {"right shin", 15, {0, -0.42, 0}, {0, -0.4, 0}, 0.058},
    {"right foot", 16, {0, -0.41, 0.02}, {0, -0.03, 0.12}, 0.046},
    {"right toe", 17, {0, -0.03, 0.12}, {0, 0, 0.06}, 0.036},
    {"cape", 2, {0, 0.2, -0.17}, {0, -0.75, -0.12}, 0.0},
};

glm::dvec3 joint_position(int bone) {
  glm::dvec3 at(0.0);
  for (int i = bone; i >= 0; i = kBones[i].parent) at += kBones[i].offset;
  return at;
}

/// A capsule from the bone's joint along its tail.
Shape capsule(const Bone& bone) {
  const double length = glm::length(bone.tail);
  std::vector<glm::dvec2> profile;
  constexpr int kArc = 5;
  for (int i = 0; i <= kArc; ++i) {
    const double angle = 0.5 * kPi * (i - kArc) / kArc;
    profile.emplace_back(i == 0 ? 0.0 : bone.radius * std::cos(angle),
                         bone.radius * std::sin(angle));
  }
  for (int i = 1; i < 4; ++i) profile.emplace_back(bone.radius, length * i / 4);
  for (int i = 0; i <= kArc; ++i) {
    const double angle = 0.5 * kPi * i / kArc;
    profile.emplace_back(i == kArc ? 0.0 : bone.radius * std::cos(angle),
                         length + bone.radius * std::sin(angle));
  }
  const glm::dvec3 up = bone.tail / length;
  const glm::dvec3 side(any_perpendicular(glm::vec3(up)));
  const glm::dvec3 right = glm::normalize(side - up * glm::dot(side, up));
  const glm::dmat4 turn(glm::dvec4(right, 0), glm::dvec4(up, 0),
                        glm::dvec4(glm::cross(right, up), 0), glm::dvec4(0, 0, 0, 1));
  Shape out;
  append(out, revolve(profile, 12), turn);
  return out;
}

SkinVertex weights(int a, int b, double share_of_b) {
  SkinVertex v;
  v.joints = glm::u16vec4(a, b, 0, 0);
  v.weights = glm::vec4(1.0 - share_of_b, share_of_b, 0, 0);
  return v;
}

/// The bones `from`..`to`, each blended with its parent over its first quarter.
void add_bones(Mesh& mesh, int from, int to, std::uint32_t material) {
  Shape shape;
  for (int i = from; i <= to; ++i) {
    const Bone& bone = kBones[i];
    if (bone.radius == 0.0) continue;
    const Shape part = capsule(bone);
    for (const Vertex& v : part.vertices) {
      const double along =
          glm::dot(glm::dvec3(v.position), bone.tail) / glm::dot(bone.tail, bone.tail);
      const double share = 0.5 * (1.0 - std::clamp(along / 0.25, 0.0, 1.0));
      mesh.skin.push_back(bone.parent < 0 ? weights(i, i, 0.0) : weights(i, bone.parent, share));
    }
    append(shape, part, translate(joint_position(i)));
  }
  add_shape(mesh, std::move(shape), material);
}

void add_cape(Mesh& mesh, std::uint32_t material) {
  const Bone& bone = kBones[kCape];
  const glm::dvec3 top = joint_position(kCape);
  // The front of the cape faces -Z.
  Shape shape = patch(top + bone.tail + glm::dvec3(0.32, 0, 0), {-0.64, 0, 0}, -bone.tail, 10, 14);
  for (const Vertex& v : shape.vertices) {
    const double along =
        glm::dot(glm::dvec3(v.position) - top, bone.tail) / glm::dot(bone.tail, bone.tail);
    mesh.skin.push_back(weights(kChest, kCape, std::clamp(along, 0.0, 1.0)));
  }
  add_shape(mesh, std::move(shape), material);
}

glm::vec4 about(const glm::dvec3& axis, double angle) {
  const glm::dquat q = glm::angleAxis(angle, axis);
  return glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w));
}

template <class F>
Channel channel(int node, ChannelPath path, const F& value) {
  Channel out;
  out.node = static_cast<std::uint32_t>(node);
  out.path = path;
  for (int key = 0; key <= kKeys; ++key) {
    out.times.push_back(static_cast<float>(kRunnerSeconds * key / kKeys));
    out.values.push_back(value(2.0 * kPi * key / kKeys));
  }
  return out;
}

/// The walk; `turn` is the angle on the circle, 0..2 pi.
Animation walk(int way) {
  Animation out;
  out.name = "walk";
  out.duration = kRunnerSeconds;
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0);
  const auto swing = [&](int bone, auto&& angle) {
    out.channels.push_back(channel(bone, ChannelPath::kRotation,
                                   [&](double turn) { return about(x, angle(kSteps * turn)); }));
  };
  out.channels.push_back(channel(kHips, ChannelPath::kTranslation, [](double turn) {
    return glm::vec4(0.0f, 0.93 + 0.02 * std::cos(2 * kSteps * turn), 0.0f, 0.0f);
  }));
  out.channels.push_back(channel(kChest, ChannelPath::kRotation, [&](double turn) {
    return about(y, 0.15 * std::sin(kSteps * turn));
  }));
  swing(kSpine, [](double) { return 0.06; });
  swing(kHead, [](double p) { return 0.05 * std::sin(2 * p); });
  for (int side = 0; side < 2; ++side) {
    const double shift = side == 0 ? 0.0 : kPi;
    const int arm = side == 0 ? 5 : 8, leg = side == 0 ? 11 : 15;
    // A positive rotation about +X swings a hanging limb backwards.
    swing(arm, [=](double p) { return 0.45 * std::sin(p + shift); });
    swing(arm + 1, [=](double p) { return -0.5 + 0.2 * std::sin(p + shift); });
    swing(leg, [=](double p) { return -0.45 * std::sin(p + shift); });
    swing(leg + 1, [=](double p) { return 0.35 - 0.35 * std::cos(p + shift + 0.6); });
    swing(leg + 2, [=](double p) { return 0.2 * std::sin(p + shift); });
  }
  swing(kCape, [](double p) { return 0.25 + 0.15 * std::sin(2 * p); });
  // A circle about the node's origin, facing along it.
  out.channels.push_back(channel(way, ChannelPath::kTranslation, [](double turn) {
    return glm::vec4(kCircle * std::sin(turn), 0.0f, kCircle * std::cos(turn), 0.0f);
  }));
  out.channels.push_back(channel(way, ChannelPath::kRotation,
                                 [&](double turn) { return about(y, turn + 0.5 * kPi); }));
  return out;
}

void add_skeleton(Scene& scene) {
  Skin skin;
  skin.name = "runner";
  for (int i = 0; i < static_cast<int>(kRunnerBones); ++i) {
    Node node;
    node.name = kBones[i].name;
    node.parent = kBones[i].parent;
    node.translation = kBones[i].offset;
    scene.nodes.push_back(node);
    skin.joints.push_back(static_cast<std::uint32_t>(i));
    skin.inverse_binds.push_back(translate(-joint_position(i)));
  }
  Node way;
  way.name = "way";
  scene.nodes.push_back(way);
  scene.skins.push_back(std::move(skin));
  scene.animations.push_back(walk(kRunnerBones));
}

std::uint32_t add_cloth(Scene& scene, const char* name, const glm::vec3& color, float roughness) {
  MaterialConstants constants;
  constants.base_color = glm::vec4(color, 1.0f);
  constants.roughness = roughness;
  constants.flags = kMaterialDoubleSided;
  return add_material(scene, name, constants);
}

}  // namespace

Scene make_runner_scene(const RunnerOptions& options) {
  Scene scene;
  scene.name = "runner";
  const std::uint32_t ground = add_cloth(scene, "ground", {0.45f, 0.43f, 0.4f}, 0.7f);
  const std::uint32_t suit = add_cloth(scene, "suit", {0.12f, 0.2f, 0.35f}, 0.5f);
  const std::uint32_t skin = add_cloth(scene, "skin", {0.6f, 0.42f, 0.33f}, 0.6f);
  const std::uint32_t cape = add_cloth(scene, "cape", {0.55f, 0.06f, 0.05f}, 0.8f);
  scene.samplers.push_back(Sampler{});
  scene.sky = default_sky();
  scene.sun = default_sun();

  Mesh floor;
  floor.name = "floor";
  add_shape(floor, patch({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}, 1, 1), ground);
  scene.meshes.push_back(std::move(floor));
  Mesh figure;
  figure.name = "runner";
  add_bones(figure, 0, 2, suit);
  add_bones(figure, 3, 4, skin);
  add_bones(figure, 5, 18, suit);
  add_cape(figure, cape);
  scene.meshes.push_back(std::move(figure));
  add_skeleton(scene);

  Instance instance;
  instance.name = "floor";
  scene.instances.push_back(instance);
  instance.mesh = 1;
  instance.motion = {.skin = 0, .animation = 0, .start = 0.0, .node = kRunnerBones};
  instance.name = "hero";
  instance.build_class = BuildClass::kHero;
  scene.instances.push_back(instance);
  instance.build_class = BuildClass::kDeformable;
  const std::uint32_t poses = std::max(options.crowd_poses, 1u);
  for (std::uint32_t i = 0; i < options.crowd; ++i) {
    instance.name = "crowd " + std::to_string(i);
    instance.motion.start = kRunnerSeconds * (i % poses + 0.5) / poses;
    // Rows of four behind the hero.
    instance.transform = translate({3.4 * ((i % 4) - 1.5), 0, -4.0 - 3.4 * (i / 4)});
    scene.instances.push_back(instance);
  }
  Camera camera;
  camera.name = "runner";
  camera.camera_to_world = look_at({0.6, 1.7, 4.6}, {0, 0.9, 0});
  scene.cameras.push_back(camera);
  return scene;
}

}  // namespace kaamos::effects
