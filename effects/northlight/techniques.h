// SPDX-License-Identifier: MIT
/// @file
/// The registry's rows of raster and screen-space techniques, by the ray traced effect that they
/// are alternatives to.
#pragma once

#include <vector>

#include "effects/northlight/effect.h"

namespace kaamos::effects {

/// How much of the sun each surface sees: alternatives to "sun".
std::vector<Effect> shadow_techniques();
/// The same by shadow maps that can be filtered.
std::vector<Effect> filtered_shadow_techniques();
/// Short shadows found in the depth picture: alternatives to "contact", and one to "sun".
std::vector<Effect> screen_shadow_techniques();
/// How open the hemisphere above each surface is: alternatives to "ao".
std::vector<Effect> ambient_occlusion_techniques();
/// Light from other surfaces: alternatives to "gi".
std::vector<Effect> indirect_techniques();
/// What each surface reflects: alternatives to "reflections".
std::vector<Effect> reflection_techniques();
/// Glass before what is opaque: alternatives to "transparent".
std::vector<Effect> glass_techniques();

}  // namespace kaamos::effects
