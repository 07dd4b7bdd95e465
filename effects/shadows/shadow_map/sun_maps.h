// SPDX-License-Identifier: MIT
/// @file
/// Places the sun's shadow maps: one over the whole scene, besides it some over single objects, or
/// cascades over parts of what the camera sees. [survey 5.1.1]
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// One map; mirrors ShadowMap of effects/shadows/shadow_map/shadow_map.hlsli.
struct SunMap {
  /// Rows. From a position relative to the camera to texels from the map's upper left corner, and
  /// metres from the plane where the map begins, along the light.
  glm::mat3x4 to_map{0.0f};
  float texel = 1;    ///< metres along its side
  float range = 1;    ///< metres that the stored depths 0 to 1 stand for
  float end = 0;      ///< view depth to which the map is used, metres
  float padding = 0;  ///< to 64 bytes
};
static_assert(sizeof(SunMap) == 64);

/// Describes what maps are made for.
struct SunMapsDesc {
  glm::dvec3 direction_to_sun{0, 1, 0};  ///< unit
  Bounds bounds;                         ///< of what casts and receives shadows, world space
  std::uint32_t size = 2048;             ///< texels along a map's side, at least 4
  std::uint32_t cascades = 0;            ///< 0: one map over `bounds`
  std::vector<Bounds> objects;           ///< without cascades: each has a map of its own, besides
  double border = 0;                     ///< metres that objects' maps reach farther on each side
  double aspect = 1;                     ///< width over height of the picture
  double split_share = 0.75;  ///< of the logarithmic split; the rest is the even one, 0 to 1
  double reach = 0;  ///< view depth where the last cascade ends, metres; 0: all of `bounds`
  /// The texels of a cascade stay where they are while the camera moves and turns. false: as tight
  /// as it goes, and shadows' edges crawl.
  bool stable = true;
};

/// View depth where cascade `i` - 1 ends and cascade `i` begins: a share of the logarithmic split,
/// the rest of the even one. 0 < near < far. [Zhang et al. 2006]
double cascade_split(double near, double far, double share, std::uint32_t i, std::uint32_t count);

/// The maps for a camera: cascades nearest first; of objects the finest first, and the scene's
/// last. An empty object, or one whose map would be no finer, has the scene's once more.
std::vector<SunMap> sun_maps(const SunMapsDesc& desc, const Camera& camera);

}  // namespace kaamos::effects
