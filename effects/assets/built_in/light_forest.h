// SPDX-License-Identifier: MIT
/// @file
/// Posts on a field with very many small lights among them, which move and flicker: for lists of
/// lights, and for filters that must forget in time.
#pragma once

#include <cstdint>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The parameters of make_light_forest.
struct LightForestDesc {
  std::uint32_t lights = 100;  ///< every third one a spot; 1 to 10,000
  std::uint32_t seed = 1;      ///< of where they are and what they are like
};

/// Lights a second: how often the brightness of one in four goes up and down.
inline constexpr double kForestFlicker = 3.0;
/// Metres: the field reaches so far from the origin along x and z.
inline constexpr double kForestHalf = 16.0;

/// The field with its lights at time 0, in the night: without a sun, below a dark sky. Ranges are
/// 0.5 to 10 m, small ones more often, so that the sum of all that reaches a point stays in bounds.
Scene make_light_forest(const LightForestDesc& desc);

/// Moves the lights of a light forest of that seed to where they are at `seconds`, each with the
/// brightness that it has then. Other scenes, by their name, keep theirs.
void move_lights(Scene& scene, double seconds, std::uint32_t seed = LightForestDesc{}.seed);

}  // namespace kaamos::effects
