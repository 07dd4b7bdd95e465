// SPDX-License-Identifier: MIT
/// @file
/// Local lights in the format that shaders read. [Northlight deck: Lighting Data]
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "effects/scene/scene.h"

namespace kaamos::effects {

/// Mirrors LightConstants of effects/shaders/lights.hlsli. Positions are relative to the camera.
struct LightConstants {
  glm::vec3 position;     ///< metres
  float range;            ///< metres; beyond it the light is black. Never 0 or infinite here
  glm::vec3 intensity;    ///< candela by colour
  float radius;           ///< of the sphere that soft shadows sample, metres
  glm::vec3 direction;    ///< the way a spot shines, unit
  float spot_scale;       ///< cone falloff = saturate(cos * scale + offset)^2; 0 for a point light
  float spot_offset;      ///< 1 for a point light
  std::uint32_t is_spot;  ///< 1: a spot, 0: a point light
  float cos_outer;        ///< of a spot's cone, at least 0.05; its shadow map ends there
  float over_range;       ///< 1 / range
  /// A spot's shadow map: direction d stands at dot(d, axis) / dot(d, direction), from -1 to 1.
  glm::vec3 map_right;
  float over_least_distance;  ///< 1 / metres; a nearer point is lit as one that far away
  glm::vec3 map_up;           ///< as map_right, the other axis
  float map_texel;            ///< radians that a texel of the shadow map covers
};
static_assert(sizeof(LightConstants) == 96);

/// Texels, of the side of a light's shadow map.
inline constexpr std::uint32_t kShadowTile = 128;

/// Illuminance, in lux, that a light without a range of its own is cut off at.
inline constexpr float kCutOffIlluminance = 1e-3f;

/// The point and spot lights of a scene, in its order; directional ones are left out. One with a
/// number that is not finite is dark; a range that is not is taken for none.
std::vector<LightConstants> light_constants(const Scene& scene, const glm::dvec3& origin);

}  // namespace kaamos::effects
