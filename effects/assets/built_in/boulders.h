// SPDX-License-Identifier: MIT
/// @file
/// Boulders with levels of detail along a way: what comes of rays that see another level than the
/// camera. [Northlight deck: Bottom Level Structures]
#pragma once

#include <cstdint>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// Levels of each boulder: 64 x 32 quads on the finest, half as many along each side from level to
/// level.
inline constexpr std::uint32_t kBoulderLevels = 4;

/// The parameters of make_boulders.
struct BouldersDesc {
  std::uint32_t count = 8;  ///< boulders, each 1.6 times as far away as the one before
  std::uint32_t seed = 1;   ///< of their lumps
};

/// Instance 0 is the ground, i + 1 boulder i. Corners of coarse levels lie on the finest, so that
/// where it is hollow a coarse level lies outside of it. The sun is low, and has no area.
Scene make_boulders(const BouldersDesc& desc);

/// The same with every boulder at one level, whatever it covers of the picture.
Scene boulders_at(const BouldersDesc& desc, std::uint32_t level);

}  // namespace kaamos::effects
