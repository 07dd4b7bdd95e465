// SPDX-License-Identifier: MIT
// Joints and weights of a primitive: all sets of them for a pose, the four strongest joints for
// what moves. [glTF 2.0: Skinned Mesh Attributes]
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "effects/assets/gltf/gltf_piece.h"

namespace kaamos::effects {
namespace {

/// One set of joints and weights, four of each for a vertex.
struct JointSet {
  std::vector<float> ids;
  std::vector<float> weights;
};

/// JOINTS_0 and WEIGHTS_0, JOINTS_1 and WEIGHTS_1, and so on.
Status read_sets(const GltfReader& reader, const tinygltf::Primitive& primitive, std::size_t count,
                 const std::string& where, std::vector<JointSet>& sets) {
  for (int n = 0;; ++n) {
    JointSet set;
    const std::string number = std::to_string(n);
    Status status =
        read_gltf_attribute(reader, primitive, "JOINTS_" + number, 4, count, where, set.ids);
    if (status.ok())
      status =
          read_gltf_attribute(reader, primitive, "WEIGHTS_" + number, 4, count, where, set.weights);
    if (!status.ok()) return status;
    if (set.ids.empty() || set.weights.empty()) return {};
    sets.push_back(std::move(set));
  }
}

bool is_used(float weight) {
  return weight > 0.0f && std::isfinite(weight);
}

/// Transform of a vertex, or nothing where no joint moves it.
Result<std::optional<glm::dmat4>> blend(const std::vector<JointSet>& sets, std::size_t vertex,
                                        const std::vector<glm::dmat4>& joints,
                                        const std::string& where) {
  glm::dmat4 m(0.0);
  double sum = 0.0;
  for (std::size_t n = 0; n < sets.size(); ++n) {
    for (std::size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) {
      const float weight = sets[n].weights[k];
      if (!is_used(weight)) continue;
      const std::size_t joint = static_cast<std::size_t>(std::max(0.0f, sets[n].ids[k]));
      if (joint >= joints.size())
        return make_error(ErrorId::kGltf, where + ", JOINTS_" + std::to_string(n) + ": element " +
                                              std::to_string(vertex) + " names joint " +
                                              std::to_string(joint) + " of " +
                                              std::to_string(joints.size()));
      m += joints[joint] * static_cast<double>(weight);
      sum += weight;
    }
  }
  if (sum <= 0.0) return std::optional<glm::dmat4>();
  return std::optional(m / sum);
}

}  // namespace

Status pose_gltf_piece(const GltfReader& reader, const tinygltf::Primitive& primitive,
                       const std::vector<glm::dmat4>& joints, const std::string& where,
                       GltfPiece& piece) {
  const std::size_t count = piece.vertices.size();
  std::vector<JointSet> sets;
  const Status status = read_sets(reader, primitive, count, where, sets);
  if (!status.ok() || sets.empty()) return status;
  for (std::size_t v = 0; v < count; ++v) {
    const Result<std::optional<glm::dmat4>> blended = blend(sets, v, joints, where);
    if (!blended.ok()) return blended.error();
    if (!blended.value()) continue;
    const glm::dmat4& m = *blended.value();
    Vertex& vertex = piece.vertices[v];
    vertex.position = glm::vec3(m * glm::dvec4(glm::dvec3(vertex.position), 1.0));
    vertex.normal =
        glm::vec3(glm::transpose(glm::inverse(glm::dmat3(m))) * glm::dvec3(vertex.normal));
    piece.has_normals &= make_unit(vertex.normal);
    glm::vec3 tangent(glm::dmat3(m) * glm::dvec3(vertex.tangent));
    piece.has_tangents &= make_unit(tangent);
    vertex.tangent = glm::vec4(tangent, vertex.tangent.w);
    const glm::vec3& p = vertex.position;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return make_error(ErrorId::kGltf, where + ": element " + std::to_string(v) +
                                            " is not finite in the pose of its skin");
  }
  return {};
}

Status read_gltf_skin(GltfReader& reader, const tinygltf::Primitive& primitive,
                      const std::string& where, GltfPiece& piece) {
  const std::size_t count = piece.vertices.size();
  std::vector<JointSet> sets;
  const Status status = read_sets(reader, primitive, count, where, sets);
  if (!status.ok() || sets.empty()) return status;
  bool left_out = false;
  piece.skin.resize(count);
  std::vector<std::pair<float, std::uint16_t>> joints;  // weight and joint
  for (std::size_t v = 0; v < count; ++v) {
    joints.clear();
    for (const JointSet& set : sets) {
      for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
        const bool used = is_used(set.weights[k]);
        joints.emplace_back(
            used ? set.weights[k] : 0.0f,
            used ? static_cast<std::uint16_t>(std::clamp(set.ids[k], 0.0f, 65535.0f)) : 0);
      }
    }
    if (sets.size() > 1)
      std::stable_sort(joints.begin(), joints.end(),
                       [](const auto& a, const auto& b) { return a.first > b.first; });
    left_out |= joints.size() > 4 && joints[4].first > 0.0f;
    SkinVertex& to = piece.skin[v];
    float sum = 0.0f;
    for (int lane = 0; lane < 4; ++lane) {
      const auto& [weight, joint] = joints[static_cast<std::size_t>(lane)];
      to.weights[lane] = weight;
      to.joints[lane] = joint;
      sum += weight;
    }
    to.weights = sum > 0.0f && std::isfinite(sum) ? to.weights / sum : glm::vec4(1, 0, 0, 0);
  }
  if (left_out)
    reader.warn_once(where +
                     ": more than 4 joints move a vertex (JOINTS_1, WEIGHTS_1); the 4 with the "
                     "largest weights count while it moves");
  return {};
}

}  // namespace kaamos::effects
