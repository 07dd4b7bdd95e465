// SPDX-License-Identifier: MIT
/// @file
/// Scenes that other renderers can show exactly as this one: flat faces; mirrors, polished diffuse
/// surfaces (roughness 0, whose Fresnel term is one number per view) and white metal (whose Fresnel
/// term is 1); light that nothing cuts off. tests/numerics compares them with Blender's Cycles.
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// An open box of 2 m with a red and a green wall, two blocks in it ("tall", "short") and a lamp of
/// 10 cm radius. Black outside. Everything is polished and diffuse.
Scene make_matched_box();
/// The same box with white metal: the tall block of roughness 0.3, and a thin "board" of 0.6.
Scene make_matched_metal();
/// A yard under a sky, lit by a sun of 2 degrees radius, with walls, a golden mirror ("mirror") and
/// an emissive quad ("panel") of radiance 6.
Scene make_matched_yard();

}  // namespace kaamos::effects
