// SPDX-License-Identifier: MIT
/// @file
/// A wall that bursts into 500 pieces behind a curtain: shapes that no update can follow, so that
/// their structures are built anew in every frame. [Northlight deck: Bottom Level Build Flags,
/// class 4; effects/SOURCES.md: E12]
#pragma once

#include <cstdint>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

inline constexpr std::uint32_t kDebrisPieces = 500;         ///< one in ten is soft
inline constexpr double kBurstSeconds = 20.0 / 30.0;        ///< frame 20 of 60
inline constexpr double kDestructionSeconds = 60.0 / 30.0;  ///< then the wall stands again

/// Instance 0 is the floor, 1 the wall, 2 the curtain; both are skinned, with a joint for each
/// piece of the wall and more for soft ones, whose upper halves swing. `build_class` is that of
/// both: kEveryFrame, or kDeformable to see what updates make of it.
Scene make_destruction(BuildClass build_class = BuildClass::kEveryFrame, std::uint32_t seed = 1);

}  // namespace kaamos::effects
