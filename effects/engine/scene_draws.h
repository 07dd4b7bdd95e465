// SPDX-License-Identifier: MIT
/// @file
/// The draws of a scene for a rasterizer: one for each geometry of each instance that rays of a
/// mask can hit.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "effects/engine/gpu_scene.h"

namespace kaamos::effects {

/// A geometry of an instance; mirrors SceneDraw of effects/surfaces/gbuffer/scene_draw.hlsli.
struct SceneDraw {
  glm::mat3x4 object_to_world{0.0f};  ///< rows, relative to the camera
  glm::mat3x4 world_to_object{0.0f};  ///< its inverse, rounded once from double
  std::uint32_t instance = 0;         ///< in GpuScene::instances
  std::uint32_t geometry = 0;         ///< in GpuScene::geometries
  std::uint32_t mask = 0;             ///< InstanceMask bits
  std::uint32_t padding = 0;          ///< to 112 bytes
};
static_assert(sizeof(SceneDraw) == 112);

/// As kMaskSolid of effects/shaders/frame.hlsli: primary rays see everything but glass.
inline constexpr std::uint32_t kMaskSolid = 0xFFu & ~static_cast<std::uint32_t>(kMaskTransparent);

/// As kMaskWithoutLamps of effects/shaders/frame.hlsli: what rays to a light see.
inline constexpr std::uint32_t kMaskCasters =
    0xFFu & ~static_cast<std::uint32_t>(kMaskTransparent | kMaskEmissiveProxy);

/// The depth buffer's near plane, as a share of the camera's: rays have none and see what is
/// nearer, and a depth buffer of floats loses nothing by it when depth is reversed.
inline constexpr float kRasterNearShare = 1.0f / 1024.0f;

/// The depth that draws have: of a perspective camera near / view depth, of an orthographic one
/// 1 - view depth / far, both reversed.
class ClipDepth {
 public:
  ClipDepth() = default;
  /// For the cameras of a valid scene: where one is orthographic, far is well behind all there is.
  explicit ClipDepth(const Scene& scene);
  /// ToClip's clip_scale: near, kRasterNearShare times the camera's; or 1 / far.
  float scale_of(const Camera& camera) const;

 private:
  Bounds bounds_;
};

/// The draws of a scene as its instances stand in GpuScene::instances now (or in drawn_instances,
/// where there are any), in their order. Left out is what no ray of instance mask `mask` can hit:
/// other instances, inactive ones, transforms without an inverse.
std::vector<SceneDraw> scene_draws(const GpuScene& gpu, std::uint32_t mask = kMaskSolid);

/// The most draws that any frame of the scene has: of instances with levels of detail the level
/// with the most geometries counts.
std::uint32_t most_scene_draws(const Scene& scene);

/// By instance, around its meshes of all levels of detail, in object space. What a skeleton moves
/// may leave the box of its bind pose: it counts as three times as large. Morph targets weigh 0
/// to 1.
std::vector<Bounds> instance_boxes(const Scene& scene);
/// Around what a draw draws, relative to the camera; `object` is its instance's box.
Bounds draw_box(const SceneDraw& draw, const Bounds& object);

}  // namespace kaamos::effects
