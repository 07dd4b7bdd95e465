// SPDX-License-Identifier: MIT
/// @file
/// Skin, an eye and hair before a mirror: what one material model for everything costs. [Control]
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The eye's painting on its ball of radius 1, which looks along +Z, `away` from its axis. Mirrors
/// EyeColor of effects/materials/eye.hlsli.
glm::vec3 eye_color(double away);

/// Instance 0 is the floor, 1 an upright mirror, 2 a ball of skin, 3 an eye, 4 a lock of hair: an
/// upright cylinder whose fibres run along its axis. The sun shines from the front, on the right.
Scene make_portrait();

}  // namespace kaamos::effects
