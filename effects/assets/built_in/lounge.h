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

/// The longest way of the loose table, metres along +x, and when it is there. Then it goes back.
///@{
inline constexpr double kTableSlide = 0.3;
inline constexpr double kTableSeconds = 2;
///@}
/// The same, seen from beside the table, which slides to and fro with its magazine: the bake of
/// indirect light does not see what moves. At time 0 it stands where it always does.
Scene make_lounge_loose_table();

}  // namespace kaamos::effects
