// SPDX-License-Identifier: MIT
/// @file
/// The registry's row of local lights.
#pragma once

#include "effects/engine/effect.h"

namespace kaamos::effects {

/// Lights surfaces by local lights, which the frame does itself: "local".
Effect local_lights_row();

}  // namespace kaamos::effects
