// SPDX-License-Identifier: MIT
// A box in front of the camera, for scenes in which nothing moves.
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::measure {

// The scene with a box that crosses what the camera looks at, 1.5 m a second.
effects::Scene with_mover(effects::Scene scene);

// The scene with a box that stands there and is far away from `seconds` on.
effects::Scene with_box_until(effects::Scene scene, double seconds);

}  // namespace kaamos::measure
