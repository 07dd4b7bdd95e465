// SPDX-License-Identifier: MIT
/// @file
/// The registry's rows of glass.
#pragma once

#include <vector>

#include "effects/engine/effect.h"

namespace kaamos::effects {

/// Traces glass before what is opaque: "transparent".
Effect transparent_row();
/// Lists the alternatives to "transparent".
std::vector<Effect> glass_alternatives();

}  // namespace kaamos::effects
