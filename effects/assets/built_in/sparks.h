// SPDX-License-Identifier: MIT
/// @file
/// Particles over a mirror: why screen-space reflections read the frame before. [survey 6.2]
#pragma once

#include <cstdint>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The parameters of make_sparks.
struct SparksDesc {
  std::uint32_t sparks = 60;  ///< that only add light
  std::uint32_t puffs = 12;   ///< of smoke, that hide half of what is behind their middle
  std::uint32_t seed = 1;     ///< of where they are
};

/// A dark blue wall over a floor that mirrors, and red sparks and grey smoke before the wall. There
/// is no light but their own and the wall's. Instance 0 is the floor, 1 the wall, whose front is at
/// z = -4.
Scene make_sparks(const SparksDesc& desc);

}  // namespace kaamos::effects
