// SPDX-License-Identifier: MIT
/// @file
/// Spots that throw pictures. [Northlight deck: Lighting Data]
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// A dark room of 6 x 3 x 5 m. One spot throws the light of a window with blinds across a table and
/// the wall, another stained glass onto the floor. A glossy floor shows both again. No sun.
Scene make_projector();

}  // namespace kaamos::effects
