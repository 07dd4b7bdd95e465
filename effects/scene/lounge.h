// SPDX-License-Identifier: MIT
// The built-in scene, after the moody lounge of Remedy's GDC 2018 talk: four small chairs that
// share one mesh of five material pieces, small sofas, large round sofas, a table with a magazine,
// a dome of thin geometry, plants of alpha-tested leaves, sun through the dome and a window. Made
// by code, the same at every call.
#pragma once

#include "effects/scene/scene.h"

namespace kaamos::effects {

/// The whole scene; passes validate(). Metres, floor at y = 0, 200,000 to 500,000 triangles.
Scene make_lounge();

}  // namespace kaamos::effects
