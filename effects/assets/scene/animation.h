// SPDX-License-Identifier: MIT
/// @file
/// The moving parts of a scene: a hierarchy of nodes, skins whose joints are nodes, and animations
/// of the nodes' translation, rotation and scale. The host evaluates poses; the device deforms the
/// vertices. [glTF 2.0: Skins, Animations]
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/scene/mesh.h"

namespace kaamos::effects {

struct Scene;

/// An index that names nothing.
inline constexpr std::int32_t kNoIndex = -1;

/// A transform in the hierarchy; joints of skins are nodes.
struct Node {
  std::string name;                ///< for people
  std::int32_t parent = kNoIndex;  ///< in Scene::nodes, before this one
  /// Relative to the parent: scale first, then rotation, then translation.
  ///@{
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1, 0, 0, 0};  ///< unit
  glm::dvec3 scale{1.0};
  ///@}
  /// In place of the three above; such a node is not animated.
  std::optional<glm::dmat4> matrix;
  std::vector<float> weights = {};  ///< of its mesh's morph targets
};

/// The skeleton of skinned meshes.
struct Skin {
  std::string name;                       ///< for people
  std::vector<std::uint32_t> joints;      ///< nodes
  std::vector<glm::dmat4> inverse_binds;  ///< as many
};

/// The property of a node that a channel moves.
enum class ChannelPath : std::uint8_t { kTranslation, kRotation, kScale, kWeights };
/// The way in which values between two times are found. [glTF 2.0: Animations]
enum class Interpolation : std::uint8_t { kStep, kLinear, kCubicSpline };

/// One property of one node over time.
struct Channel {
  std::uint32_t node = 0;                                ///< in Scene::nodes
  ChannelPath path = ChannelPath::kRotation;             ///< which property
  Interpolation interpolation = Interpolation::kLinear;  ///< rotations along the arc
  std::vector<float> times;                              ///< seconds, rising
  /// One per time; rotations are x, y, z, w. With kCubicSpline three: in-tangent, value,
  /// out-tangent.
  std::vector<glm::vec4> values;
  /// In place of `values` for kWeights: as many for each of those as the node has weights.
  std::vector<float> weights = {};
};

/// Channels that play together, over and over.
struct Animation {
  std::string name;               ///< for people
  std::vector<Channel> channels;  ///< at most one for each property of a node
  double duration = 0.0;          ///< seconds; then it begins anew
};

/// The motion of an instance.
struct Motion {
  std::int32_t skin = kNoIndex;       ///< in Scene::skins; its mesh has SkinVertices
  std::int32_t animation = kNoIndex;  ///< in Scene::animations; none: the nodes' rest
  double start = 0.0;                 ///< seconds, added to the scene's time
  /// The instance is fixed to this node: object to world = transform * node's.
  std::int32_t node = kNoIndex;
  std::int32_t morph = kNoIndex;  ///< the node whose weights move its mesh, which has morph targets
  /// True if all members are equal: the same pose at every time.
  bool operator==(const Motion&) const = default;
};

/// Upper three rows, as a shader has a float3x4.
using JointMatrix = glm::mat3x4;

/// An instance at one moment.
struct InstanceState {
  glm::dmat4 transform{1.0};        ///< object to world
  std::vector<JointMatrix> joints;  ///< bind pose to object space; empty: not skinned
  std::vector<float> weights = {};  ///< of morph targets; empty: none move it
  std::int32_t mesh = kNoIndex;     ///< the level of detail to show; none: the instance's mesh

  /// True where the shape of its mesh moves.
  bool is_deformed() const { return !joints.empty() || !weights.empty(); }
};

/// Node to scene transforms at `seconds`, which wraps at the animation's end.
std::vector<glm::dmat4> evaluate_nodes(const Scene& scene, std::int32_t animation, double seconds);
/// Returns where the instances of a valid scene are at `seconds`, one state for each. [glTF 2.0:
/// Skins]
std::vector<InstanceState> evaluate_instances(const Scene& scene, double seconds);

/// Computes on the host what the skinning shader does: morph targets move vertices first, then
/// joints.
std::vector<Vertex> deform_vertices(const Mesh& mesh, const InstanceState& state);
/// The second half: blended matrices move positions, their cofactors turn normals.
std::vector<Vertex> skin_vertices(const Mesh& mesh, std::span<const JointMatrix> joints);

/// A valid scene as it is at `seconds`, where nothing moves any more: skinned meshes are deformed,
/// each for its instance alone. Motions, nodes, skins and animations are gone.
Scene posed_scene(Scene scene, double seconds);

}  // namespace kaamos::effects
