// SPDX-License-Identifier: MIT
/// @file
/// Ten kilometres of hills below a low sun, with towers from a millimetre to a kilometre high, and
/// all of it anywhere: what single precision and fixed offsets of rays get wrong.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

inline constexpr double kTerrainSize = 10000.0;     ///< metres, along each side
inline constexpr std::uint32_t kTerrainCells = 96;  ///< along each side
/// The towers: so many, each tenfold as high as the one before, the first one this high. Tower i
/// stands 3 times its height before the first camera, at 3 mm to 3 km.
///@{
inline constexpr std::uint32_t kTowers = 7;
inline constexpr double kLeastTower = 1e-3;
///@}

/// The parameters of make_terrain.
struct TerrainDesc {
  glm::dvec3 offset{0.0};      ///< metres: the scene and its cameras are moved by so much
  double sun_elevation = 0.2;  ///< radians over the horizon, towards -x
  std::uint32_t seed = 1;      ///< of the hills
};

/// The middle, where the first camera stands, is level ground of one triangle pair; hills rise from
/// 300 m on. Instance 0 is the hills, 1 the level ground, then the towers by height. The sun has no
/// area, so that shadows are hard. Wherever it is, the picture is the same to the last bit: what
/// differs by the offset is an error.
Scene make_terrain(const TerrainDesc& desc);

}  // namespace kaamos::effects
