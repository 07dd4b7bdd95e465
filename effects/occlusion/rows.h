// SPDX-License-Identifier: MIT
/// @file
/// The registry's rows of ambient occlusion.
#pragma once

#include <vector>

#include "effects/engine/effect.h"

namespace kaamos::effects {

/// Shows how open the hemisphere above each surface is: "ao".
Effect ambient_occlusion_row();
/// Lists the alternatives to "ao".
std::vector<Effect> occlusion_alternatives();

}  // namespace kaamos::effects
