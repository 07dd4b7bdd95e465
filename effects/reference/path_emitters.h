// SPDX-License-Identifier: MIT
/// @file
/// The emitters that the reference samples as lights besides the sun and lamps: emissive triangles,
/// and the sky by bands of height.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// Mirrors PathEmitter of path_lights.hlsli: a triangle, relative to the camera.
struct PathEmitter {
  glm::vec3 corner;        ///< metres
  std::uint32_t material;  ///< in Scene::materials
  glm::vec3 edge1;         ///< to the second corner
  float keep;              ///< alias method: chance to keep this triangle where it is drawn
  glm::vec3 edge2;         ///< to the third corner
  std::uint32_t other;     ///< the one to take instead
  glm::vec2 uv0;           ///< of the first corner
  glm::vec2 uv1;           ///< of the second
  glm::vec2 uv2;           ///< of the third
  /// Opacity of the corners, 16 bits each; all ones where vertices have no colours.
  glm::uvec2 alphas{0xFFFFFFFFu};
};
static_assert(sizeof(PathEmitter) == 80);

/// The emissive triangles of a scene, drawn by area and brightness.
struct PathEmitters {
  std::vector<PathEmitter> triangles;  ///< of all instances
  /// By material: the chance of a point, per square metre. 0: it does not glow.
  std::vector<float> densities;
  /// By instance: 1 where its emissive triangles are among `triangles`. Pictures of lamps, glass
  /// and skinned meshes are not; rays meet what glows on skinned meshes all the same.
  std::vector<std::uint32_t> instances;
};

/// `states`: where the instances are, one state for each. `origin`: of the camera.
PathEmitters find_emitters(const Scene& scene, std::span<const InstanceState> states,
                           const glm::dvec3& origin);

/// Bands of equal height of the sphere of directions, from straight down to straight up.
inline constexpr std::uint32_t kSkyBands = 128;

/// Chance that a sampled direction lies below each border of the bands, kSkyBands + 1 values from 0
/// to 1, by the sky's brightness. Empty: the sky is black.
std::vector<float> sky_bands(const Sky& sky);

}  // namespace kaamos::effects
