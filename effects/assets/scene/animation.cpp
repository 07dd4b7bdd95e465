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

/// A moment among the times of a channel.
struct Moment {
  std::size_t key = 0;
  bool holds = true;  ///< the value is that of `key`; else it lies between that and the next
  double step = 0;    ///< seconds between the two
  double u = 0;       ///< 0..1 of that
};

Moment moment_of(const Channel& channel, double seconds) {
  Moment out;
  const auto after = std::upper_bound(channel.times.begin(), channel.times.end(), seconds);
  if (after == channel.times.begin()) return out;
  out.key = static_cast<std::size_t>(after - channel.times.begin()) - 1;
  if (after == channel.times.end() || channel.interpolation == Interpolation::kStep) return out;
  out.holds = false;
  const double begin = channel.times[out.key];
  out.step = channel.times[out.key + 1] - begin;
  out.u = (seconds - begin) / out.step;
  return out;
}

/// [glTF 2.0: Appendix C, cubic spline interpolation]
template <class T>
T interpolate_cubic(const Moment& at, const T& value, const T& out_tangent, const T& in_tangent,
                    const T& next) {
  const double u = at.u, u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * value + at.step * (u3 - 2 * u2 + u) * out_tangent +
         (3 * u2 - 2 * u3) * next + at.step * (u3 - u2) * in_tangent;
}

/// `values(key, part)`: part of a key, 0 without cubic splines, else in-tangent, value,
/// out-tangent; `mix`: of two values.
template <class Values, class Mix>
auto value_at(const Channel& channel, const Moment& at, const Values& values, const Mix& mix) {
  const bool cubic = channel.interpolation == Interpolation::kCubicSpline;
  const auto here = values(at.key, cubic ? 1 : 0);
  if (at.holds) return here;
  if (!cubic) return mix(here, values(at.key + 1, 0), at.u);
  return interpolate_cubic(at, here, values(at.key, 2), values(at.key + 1, 0),
                           values(at.key + 1, 1));
}

glm::dvec4 value_at(const Channel& channel, double seconds) {
  const std::size_t per_key = channel.interpolation == Interpolation::kCubicSpline ? 3 : 1;
  return value_at(
      channel, moment_of(channel, seconds),
      [&](std::size_t key, std::size_t part) {
        return glm::dvec4(channel.values[per_key * key + part]);
      },
      [&](const glm::dvec4& a, const glm::dvec4& b, double u) {
        return interpolate_linear(channel.path, a, b, u);
      });
}

glm::dmat4 local_transform(const Node& node) {
  if (node.matrix) return *node.matrix;
  glm::dmat4 m = glm::mat4_cast(node.rotation);
  for (int c = 0; c < 3; ++c) m[c] *= node.scale[c];
  m[3] = glm::dvec4(node.translation, 1.0);
  return m;
}

void apply_weights(const Channel& channel, double seconds, std::vector<float>& weights) {
  const std::size_t per_key = channel.interpolation == Interpolation::kCubicSpline ? 3 : 1;
  const Moment at = moment_of(channel, seconds);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = static_cast<float>(value_at(
        channel, at,
        [&](std::size_t key, std::size_t part) {
          return double{channel.weights[(per_key * key + part) * weights.size() + i]};
        },
        [](double a, double b, double u) { return a == b ? a : glm::mix(a, b, u); }));
  }
}

void apply(const Animation& animation, double seconds, std::vector<Node>& nodes) {
  double t = seconds;
  if (animation.duration > 0) t -= animation.duration * std::floor(t / animation.duration);
  for (const Channel& channel : animation.channels) {
    Node& node = nodes[channel.node];
    if (channel.path == ChannelPath::kWeights) {
      apply_weights(channel, t, node.weights);
      continue;
    }
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
      case ChannelPath::kWeights:
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

std::vector<Node> nodes_at(const Scene& scene, std::int32_t animation, double seconds) {
  std::vector<Node> nodes = scene.nodes;
  if (animation != kNoIndex) {
    apply(scene.animations[static_cast<std::size_t>(animation)], seconds, nodes);
  }
  return nodes;
}

std::vector<glm::dmat4> transforms_of(const std::vector<Node>& nodes) {
  std::vector<glm::dmat4> transforms;
  for (const Node& node : nodes) {
    const glm::dmat4 local = local_transform(node);
    transforms.push_back(node.parent == kNoIndex
                             ? local
                             : transforms[static_cast<std::size_t>(node.parent)] * local);
  }
  return transforms;
}

/// All nodes at one moment.
struct Pose {
  std::vector<Node> nodes;
  std::vector<glm::dmat4> transforms;
};

/// Moves vertices by morph targets.
void morph_vertices(const Mesh& mesh, std::span<const float> weights, std::vector<Vertex>& out) {
  const std::size_t count = std::min<std::size_t>(weights.size(), mesh.morph_targets);
  for (std::size_t i = 0; i < out.size() && count > 0; ++i) {
    Vertex& v = out[i];
    glm::vec3 normal = v.normal, tangent(v.tangent);
    for (std::size_t t = 0; t < count; ++t) {
      const MorphMove& move = mesh.morph[i * mesh.morph_targets + t];
      v.position += weights[t] * move.position;
      normal += weights[t] * move.normal;
      tangent += weights[t] * move.tangent;
    }
    if (glm::dot(normal, normal) > 0) v.normal = glm::normalize(normal);
    if (glm::dot(tangent, tangent) > 0) v.tangent = glm::vec4(glm::normalize(tangent), v.tangent.w);
  }
}

void skin_in_place(const Mesh& mesh, std::span<const JointMatrix> joints,
                   std::vector<Vertex>& out) {
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
}

}  // namespace

std::vector<glm::dmat4> evaluate_nodes(const Scene& scene, std::int32_t animation, double seconds) {
  return transforms_of(nodes_at(scene, animation, seconds));
}

std::vector<InstanceState> evaluate_instances(const Scene& scene, double seconds) {
  std::map<std::pair<std::int32_t, double>, Pose> poses;
  std::vector<InstanceState> states;
  for (const Instance& instance : scene.instances) {
    const Motion& motion = instance.motion;
    InstanceState state;
    state.transform = instance.transform;
    if (motion.skin != kNoIndex || motion.node != kNoIndex || motion.morph != kNoIndex) {
      Pose& pose = poses[{motion.animation, motion.start}];
      if (pose.nodes.empty()) {
        pose.nodes = nodes_at(scene, motion.animation, seconds + motion.start);
        pose.transforms = transforms_of(pose.nodes);
      }
      const std::vector<glm::dmat4>& nodes = pose.transforms;
      if (motion.morph != kNoIndex) {
        state.weights = pose.nodes[static_cast<std::size_t>(motion.morph)].weights;
      }
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

std::vector<Vertex> deform_vertices(const Mesh& mesh, const InstanceState& state) {
  std::vector<Vertex> out = mesh.vertices;
  morph_vertices(mesh, state.weights, out);
  if (!state.joints.empty()) skin_in_place(mesh, state.joints, out);
  return out;
}

std::vector<Vertex> skin_vertices(const Mesh& mesh, std::span<const JointMatrix> joints) {
  std::vector<Vertex> out = mesh.vertices;
  skin_in_place(mesh, joints, out);
  return out;
}

Scene posed_scene(Scene scene, double seconds) {
  const std::vector<InstanceState> states = evaluate_instances(scene, seconds);
  for (std::size_t i = 0; i < states.size(); ++i) {
    Instance& instance = scene.instances[i];
    instance.transform = states[i].transform;
    instance.motion = {};
    instance.build_class = BuildClass::kStatic;
    if (!states[i].is_deformed()) continue;
    Mesh posed = scene.meshes[instance.mesh];
    posed.vertices = deform_vertices(posed, states[i]);
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(posed));
  }
  for (Mesh& mesh : scene.meshes) {
    mesh.skin.clear();
    mesh.morph.clear();
    mesh.morph_targets = 0;
  }
  scene.nodes.clear();
  scene.skins.clear();
  scene.animations.clear();
  return scene;
}

}  // namespace kaamos::effects
