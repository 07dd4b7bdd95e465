// SPDX-License-Identifier: MIT
/// @file
/// The registry's rows of shadows.
#pragma once

#include <vector>

#include "effects/engine/effect.h"

namespace kaamos::effects {

/// Shows how much of the sun each surface sees: "sun".
Effect sun_shadow_row();
/// Shows the colour that glass gives to the sun's light: "glass-shadow".
Effect glass_shadow_row();
/// Shows short shadows of the strongest lights: "contact".
Effect contact_shadow_row();
/// Shows how much of one local light each surface sees, by any of LampShadow: "lamp-shadow". No row
/// of the registry: for measuring.
Effect lamp_shadow_row();
/// Lists the alternatives to "sun", "glass-shadow" and "contact".
std::vector<Effect> shadow_alternatives();

/// Parts of the alternatives.
///@{
std::vector<Effect> filtered_shadow_rows();  ///< the sun's shadow by maps that are filtered first
std::vector<Effect> screen_shadow_rows();    ///< short shadows found in the depth picture
std::vector<Effect> lamp_shadow_rows();      ///< whole shadows of each pixel's strongest lamps
///@}

}  // namespace kaamos::effects
