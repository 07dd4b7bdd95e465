// SPDX-License-Identifier: MIT
/// @file
/// The built-in scene, after the moody lounge of Remedy's GDC 2018 talk: four small chairs that
/// share one mesh of five materials, small sofas, large round sofas, a table with a magazine, a
/// dome of thin geometry, plants with alpha-tested leaves, and sun through the dome and a window.
/// It is made by code and is the same at every call.
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The whole scene; passes validate(). Metres, floor at y = 0, 200,000 to 500,000 triangles.
Scene make_lounge();

}  // namespace kaamos::effects
