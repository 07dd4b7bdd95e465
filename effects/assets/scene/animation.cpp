// SPDX-License-Identifier: MIT
#include "effects/assets/scene/animation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {
namespace {

glm::dquat quaternion(const glm::dvec4& v) {
  return glm::dquat(v.w, v.x, v.y, v.z);
}

glm::dvec4 interpolate_linear(ChannelPath path, const glm::dvec4& a, const glm::dvec4& b,
                              double u) {
  if (a == b) return a;  // to the bit: what stands still need not be built again
  if (path != ChannelPath::kRotation) return glm::mix(a, b, u);
  const glm::dquat q = glm::slerp(quaternion(a), quaternion(b), u);  // takes the shorter arc
  return {q.x, q.y, q.z, q.w};
}

/// [glTF 2.0: Appendix C, cubic spline interpolation]
glm::dvec4 interpolate_cubic(const Channel& channel, std::size_t key, double step, double u) {
  const glm::dvec4 value(channel.values[3 * key + 1]);
  const glm::dvec4 out_tangent(channel.values[3 * key + 2]);
  const glm::dvec4 in_tangent(channel.values[3 * key + 3]);
  const glm::dvec4 next(channel.values[3 * key + 4]);
  const double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * value + step * (u3 - 2 * u2 + u) * out_tangent +
         (3 * u2 - 2 * u3) * next + step * (u3 - u2) * in_tangent;
}

glm::dvec4 value_at(const Channel& channel, double seconds) {
  const bool cubic = channel.interpolation == Interpolation::kCubicSpline;
  const auto key_value = [&](std::size_t key) {
    return glm::dvec4(channel.values[cubic ? 3 * key + 1 : key]);
  };
  const auto after = std::upper_bound(channel.times.begin(), channel.times.end(), seconds);
  if (after == channel.times.begin()) return key_value(0);
  const std::size_t key = static_cast<std::size_t>(after - channel.times.begin()) - 1;
  if (after == channel.times.end() || channel.interpolation == Interpolation::kStep) {
    return key_value(key);
  }
  const double begin = channel.times[key];
  const double step = channel.times[key + 1] - begin;
  const double u = (seconds - begin) / step;
  return cubic ? interpolate_cubic(channel, key, step, u)
               : interpolate_linear(channel.path, key_value(key), key_value(key + 1), u);
}

glm::dmat4 local_transform(const Node& node) {
  if (node.matrix) return *node.matrix;
  glm::dmat4 m = glm::mat4_cast(node.rotation);
  for (int c = 0; c < 3; ++c) m[c] *= node.scale[c];
  m[3] = glm::dvec4(node.translation, 1.0);
  return m;
}

void apply(const Animation& animation, double seconds, std::vector<Node>& nodes) {
  double t = seconds;
  if (animation.duration > 0) t -= animation.duration * std::floor(t / animation.duration);
  for (const Channel& channel : animation.channels) {
    Node& node = nodes[channel.node];
    const glm::dvec4 value = value_at(channel, t);
    switch (channel.path) {
      case ChannelPath::kTranslation:
        node.translation = glm::dvec3(value);
        break;
      case ChannelPath::kRotation: {
        const glm::dquat q = quaternion(value);
        if (glm::length(q) > 0) node.rotation = glm::normalize(q);
        break;
      }
      case ChannelPath::kScale:
        node.scale = glm::dvec3(value);
        break;
    }
  }
}

std::vector<JointMatrix> joint_matrices(const Skin& skin, const std::vector<glm::dmat4>& nodes) {
  std::vector<JointMatrix> joints;
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const glm::dmat4 rows = glm::transpose(nodes[skin.joints[i]] * skin.inverse_binds[i]);
    joints.emplace_back(glm::vec4(rows[0]), glm::vec4(rows[1]), glm::vec4(rows[2]));
  }
  return joints;
}

}  // namespace

std::vector<glm::dmat4> evaluate_nodes(const Scene& scene, std::int32_t animation, double seconds) {
  std::vector<Node> nodes = scene.nodes;
  if (animation != kNoIndex) {
    apply(scene.animations[static_cast<std::size_t>(animation)], seconds, nodes);
  }
  std::vector<glm::dmat4> transforms;
  for (const Node& node : nodes) {
    const glm::dmat4 local = local_transform(node);
    transforms.push_back(node.parent == kNoIndex
                             ? local
                             : transforms[static_cast<std::size_t>(node.parent)] * local);
  }
  return transforms;
}

std::vector<InstanceState> evaluate_instances(const Scene& scene, double seconds) {
  std::map<std::pair<std::int32_t, double>, std::vector<glm::dmat4>> poses;
  std::vector<InstanceState> states;
  for (const Instance& instance : scene.instances) {
    const Motion& motion = instance.motion;
    InstanceState state;
    state.transform = instance.transform;
    if (motion.skin != kNoIndex || motion.node != kNoIndex) {
      auto& nodes = poses[{motion.animation, motion.start}];
      if (nodes.empty()) nodes = evaluate_nodes(scene, motion.animation, seconds + motion.start);
      if (motion.node != kNoIndex) {
        state.transform = instance.transform * nodes[static_cast<std::size_t>(motion.node)];
      }
      if (motion.skin != kNoIndex) {
        state.joints = joint_matrices(scene.skins[static_cast<std::size_t>(motion.skin)], nodes);
      }
    }
    states.push_back(std::move(state));
  }
  return states;
}

std::vector<Vertex> skin_vertices(const Mesh& mesh, std::span<const JointMatrix> joints) {
  std::vector<Vertex> out = mesh.vertices;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const SkinVertex& skin = mesh.skin[i];
    JointMatrix m(0.0f);
    for (int k = 0; k < 4; ++k) m += joints[skin.joints[k]] * skin.weights[k];
    Vertex& v = out[i];
    const glm::vec3 r0(m[0]), r1(m[1]), r2(m[2]);
    const glm::vec4 p(v.position, 1.0f);
    v.position = glm::vec3(glm::dot(m[0], p), glm::dot(m[1], p), glm::dot(m[2], p));
    const glm::vec3 c0 = glm::cross(r1, r2), c1 = glm::cross(r2, r0), c2 = glm::cross(r0, r1);
    const float side = glm::dot(r0, c0) < 0 ? -1.0f : 1.0f;
    const glm::vec3 n =
        side * glm::vec3(glm::dot(c0, v.normal), glm::dot(c1, v.normal), glm::dot(c2, v.normal));
    const glm::vec3 from(v.tangent);
    const glm::vec3 t(glm::dot(r0, from), glm::dot(r1, from), glm::dot(r2, from));
    if (glm::dot(n, n) > 0) v.normal = glm::normalize(n);
    if (glm::dot(t, t) > 0) v.tangent = glm::vec4(glm::normalize(t), side * v.tangent.w);
  }
  return out;
}

Scene posed_scene(Scene scene, double seconds) {
  const std::vector<InstanceState> states = evaluate_instances(scene, seconds);
  for (std::size_t i = 0; i < states.size(); ++i) {
    Instance& instance = scene.instances[i];
    instance.transform = states[i].transform;
    instance.motion = {};
    instance.build_class = BuildClass::kStatic;
    if (states[i].joints.empty()) continue;
    Mesh posed = scene.meshes[instance.mesh];
    posed.vertices = skin_vertices(posed, states[i].joints);
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(posed));
  }
  for (Mesh& mesh : scene.meshes) mesh.skin.clear();
  scene.nodes.clear();
  scene.skins.clear();
  scene.animations.clear();
  return scene;
}

}  // namespace kaamos::effects
