// SPDX-License-Identifier: MIT
/// @file
/// The registry's rows of reflections.
#pragma once

#include <vector>

#include "effects/engine/effect.h"

namespace kaamos::effects {

/// Traces opaque reflections: "reflections".
Effect reflections_row();
/// Lists the alternatives to "reflections".
std::vector<Effect> reflection_alternatives();

}  // namespace kaamos::effects
