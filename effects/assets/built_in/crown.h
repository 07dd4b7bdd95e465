// SPDX-License-Identifier: MIT
/// @file
/// A crown with spikes and crevices on a plane, for ambient occlusion: wide open beside narrow
/// gaps. [survey 7.4]
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

inline constexpr std::uint32_t kCrownSpikes = 24;  ///< half of them with a gem at the tip
inline constexpr double kCrownRadius = 0.5;        ///< metres, of the band
inline constexpr double kCrownGroove = 0.35;       ///< metres above the plane, of the band's groove

/// The crown stands about the origin on the plane y = 0. Instance 0 is the plane, 1 the band, 2 the
/// cap inside; then the spikes and their gems.
Scene make_crown();

}  // namespace kaamos::effects
