// SPDX-License-Identifier: MIT
/// @file
/// A hall of mirrors.
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

inline constexpr int kMirrorHallSteps = 11;          ///< patches of the strip
inline constexpr double kMirrorHallHalfWidth = 2.0;  ///< metres; the mirrors stand at x = +-this

/// Two mirrors face each other (instances 0, "mirror left", and 1, "mirror right", roughness 0); on
/// the floor between them a strip of metal ("strip 0" to "strip 10") whose roughness goes from 0 to
/// 1; coloured props behind the camera and above the picture, which only reflections show; rods as
/// thin as a pixel of a picture 720 rows high; and a bulb of radiance 10,000.
Scene make_mirror_hall();

}  // namespace kaamos::effects
