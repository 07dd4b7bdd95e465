// SPDX-License-Identifier: MIT
#include "effects/engine/scene_draws.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace kaamos::effects {

namespace {

// False where there is no inverse.
bool invert(const glm::mat3x4& rows, glm::mat3x4& inverse) {
  const glm::dmat3 linear{glm::dvec3(rows[0]), glm::dvec3(rows[1]), glm::dvec3(rows[2])};
  const double determinant = glm::determinant(linear);
  if (determinant == 0 || !std::isfinite(determinant)) return false;
  // GLM's columns are rows here, before and behind.
  const glm::dmat3 inverse_linear = glm::inverse(linear);
  const glm::dvec3 translation(rows[0].w, rows[1].w, rows[2].w);
  for (int row = 0; row < 3; ++row) {
    const glm::dvec3& by = inverse_linear[row];
    inverse[row] = glm::vec4(glm::vec3(by), static_cast<float>(-glm::dot(by, translation)));
    for (int i = 0; i < 4; ++i) {
      if (!std::isfinite(inverse[row][i])) return false;
    }
  }
  return true;
}

// The geometries of a mesh follow each other.
std::size_t end_of_mesh(const std::vector<GpuGeometry>& geometries, std::size_t first) {
  std::size_t end = first + 1;
  while (end < geometries.size() && geometries[end].constants.geometry_id == end - first) ++end;
  return std::min(end, geometries.size());
}

}  // namespace

std::vector<SceneDraw> scene_draws(const GpuScene& gpu, std::uint32_t mask) {
  std::vector<SceneDraw> out;
  if (!gpu.instances) return out;
  const auto descs = (gpu.drawn_instances ? gpu.drawn_instances : gpu.instances)
                         .data<rtapi::RaytracingInstanceDesc>();
  for (std::size_t i = 0; i < descs.size(); ++i) {
    const rtapi::RaytracingInstanceDesc& desc = descs[i];
    if ((desc.InstanceMask & mask) == 0 || desc.AccelerationStructure == 0) continue;
    SceneDraw draw;
    std::memcpy(&draw.object_to_world, desc.Transform, sizeof desc.Transform);
    if (!invert(draw.object_to_world, draw.world_to_object)) continue;
    draw.instance = static_cast<std::uint32_t>(i);
    draw.mask = desc.InstanceMask;
    const std::size_t first = desc.InstanceContributionToHitGroupIndex / kRayTypeCount;
    for (std::size_t g = first; g < end_of_mesh(gpu.geometries, first); ++g) {
      draw.geometry = static_cast<std::uint32_t>(g);
      if (gpu.geometries[g].index_count > 0) out.push_back(draw);
    }
  }
  return out;
}

std::uint32_t most_scene_draws(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) {
    std::size_t most = scene.meshes[instance.mesh].geometries.size();
    for (const Level& level : instance.levels) {
      most = std::max(most, scene.meshes[level.mesh].geometries.size());
    }
    count += most;
  }
  return static_cast<std::uint32_t>(count);
}

namespace {

// Adds where morph targets with weights of 0 to 1 can move the vertices.
void add_morphed(const Mesh& mesh, Bounds& box) {
  for (std::size_t i = 0; i < mesh.vertices.size() && mesh.morph_targets > 0; ++i) {
    glm::dvec3 low(mesh.vertices[i].position), high = low;
    for (std::size_t t = 0; t < mesh.morph_targets; ++t) {
      const glm::dvec3 move(mesh.morph[i * mesh.morph_targets + t].position);
      low += glm::min(move, glm::dvec3(0.0));
      high += glm::max(move, glm::dvec3(0.0));
    }
    box.add(low);
    box.add(high);
  }
}

}  // namespace

std::vector<Bounds> instance_boxes(const Scene& scene) {
  std::vector<Bounds> out;
  for (const Instance& instance : scene.instances) {
    Bounds box;
    const auto add = [&](std::uint32_t mesh) {
      Bounds own = scene.meshes[mesh].bounds();
      add_morphed(scene.meshes[mesh], own);
      if (own.empty()) return;
      const glm::dvec3 more = scene.meshes[mesh].skin.empty() ? glm::dvec3(0.0) : own.size();
      box.add(own.min - more);
      box.add(own.max + more);
    };
    add(instance.mesh);
    for (const Level& level : instance.levels) add(level.mesh);
    out.push_back(box);
  }
  return out;
}

Bounds draw_box(const SceneDraw& draw, const Bounds& object) {
  Bounds out;
  if (object.empty()) return out;
  // GLM's columns are rows here.
  const glm::dmat3x4 rows(draw.object_to_world);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec4 corner((i & 1) != 0 ? object.max.x : object.min.x,
                            (i & 2) != 0 ? object.max.y : object.min.y,
                            (i & 4) != 0 ? object.max.z : object.min.z, 1.0);
    out.add(glm::dvec3(glm::dot(rows[0], corner), glm::dot(rows[1], corner),
                       glm::dot(rows[2], corner)));
  }
  return out;
}

ClipDepth::ClipDepth(const Scene& scene) {
  const auto& cameras = scene.cameras;
  if (std::any_of(cameras.begin(), cameras.end(),
                  [](const Camera& camera) { return camera.is_orthographic(); }))
    bounds_ = scene_bounds(scene);
}

float ClipDepth::scale_of(const Camera& camera) const {
  if (!camera.is_orthographic()) return static_cast<float>(camera.near_plane) * kRasterNearShare;
  // What moves may leave the box, which is that of time 0. A float near 1 has 24 bits: depths of
  // surfaces are told apart by some 1e-6 of the box.
  constexpr double kRoom = 4.0;
  const double size = glm::length(bounds_.size());
  const glm::dvec3 center = bounds_.empty() ? camera.position() : bounds_.center();
  const double middle = glm::dot(center - camera.position(), camera.forward());
  return static_cast<float>(1.0 / std::max(middle + kRoom * size, 1e-6));
}

}  // namespace kaamos::effects
