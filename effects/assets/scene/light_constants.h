// SPDX-License-Identifier: MIT
/// @file
/// Local lights in the format that shaders read. [Northlight deck: Lighting Data]
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "effects/assets/scene/scene.h"

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
  std::int32_t projection;    ///< a spot's projection map, of the bindless textures; -1: none
  std::uint32_t projection_sampler;  ///< of the bindless samplers
  glm::vec2 padding;                 ///< to 112 bytes
};
static_assert(sizeof(LightConstants) == 112);

/// Texels, of the side of a light's shadow map.
inline constexpr std::uint32_t kShadowTile = 128;

/// Tiles of lights in a row of the atlas of shadow maps.
inline constexpr std::uint32_t kShadowTilesPerRow = 32;

/// Texels of the side of the largest map of the sun.
inline constexpr std::uint32_t kMaxSunMap = 8192;

/// The atlas of shadow maps, in texels: the lights' tiles, and right of them the sun's map.
struct AtlasLayout {
  std::uint32_t tile_width = 0;   ///< of all tiles
  std::uint32_t tile_height = 0;  ///< of all tiles
  std::uint32_t sun = 0;          ///< side of the sun's map; 0: it has none
  std::uint32_t width = 0;        ///< of the atlas
  std::uint32_t height = 0;       ///< of the atlas
};

/// The atlas for so many local lights and a map of the sun of that side.
AtlasLayout atlas_layout(std::uint32_t light_count, std::uint32_t sun_map);

/// The sun's map in the atlas, as FrameConstants have it. Positions are relative to the camera.
struct SunMapConstants {
  glm::vec3 centre{0.0f};  ///< of all that casts shadows
  float reach = 0;         ///< metres from there to where its rays begin, and to their end
  glm::vec3 right{0.0f};   ///< a point p stands at dot(p - centre, right), from -1 to 1
  float texel = 0;         ///< metres
  glm::vec3 up{0.0f};      ///< as `right`, the other axis
  std::uint32_t size = 0;  ///< texels along its side; 0: there is no map
};

/// A map of that many texels a side over `bounds` (world space, not empty), for a camera at
/// `origin`. It stays where it is in the world when the camera moves.
SunMapConstants sun_map_constants(const Bounds& bounds, const glm::vec3& direction_to_sun,
                                  std::uint32_t size, const glm::dvec3& origin);

/// Illuminance, in lux, that a light without a range of its own is cut off at.
inline constexpr float kCutOffIlluminance = 1e-3f;

/// The point and spot lights of a scene, in its order; directional ones are left out. One with a
/// number that is not finite is dark; a range that is not is taken for none.
std::vector<LightConstants> light_constants(const Scene& scene, const glm::dvec3& origin);

}  // namespace kaamos::effects
