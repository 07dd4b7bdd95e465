// SPDX-License-Identifier: MIT
/// @file
/// The registry's rows of light from other surfaces.
#pragma once

#include <vector>

#include "effects/engine/effect.h"

namespace kaamos::effects {

/// Gathers indirect diffuse light: "gi".
Effect indirect_diffuse_row();
/// Lists the alternatives to "gi".
std::vector<Effect> indirect_alternatives();

}  // namespace kaamos::effects
