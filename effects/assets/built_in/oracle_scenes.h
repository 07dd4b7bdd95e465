// SPDX-License-Identifier: MIT
/// @file
/// Scenes with a known answer in closed form, to test effects against.
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// A plane y = 0 (instance 0, "plane") and a sphere (instance 1, "sphere") whose centre stands
/// `height` over the origin, height >= radius. The camera looks at the plane from above and aside.
Scene make_sphere_oracle(double radius, double height);
/// Occluded share of the cosine-weighted hemisphere of a point of the plane at distance `x` from
/// the origin, rays unlimited: 1 - ambient visibility.
double sphere_occlusion(double radius, double height, double x);

/// A plane y = 0 for x > 0 (instance 0, "plane") before a wall x = 0 of the given height (instance
/// 1, "wall"), both so long in z that their ends cannot be told from none.
Scene make_wall_oracle(double height);
/// For a point at distance x > 0 from the wall, rays unlimited.
double wall_occlusion(double height, double x);
/// For a wall that is higher than the rays are long: ray length `length`.
double wall_occlusion_bounded(double length, double x);

/// A plane y = 0 (instance 0, "plane") and over its half x < 0, at `height`, a sheet with a
/// straight edge along z (instance 1, "edge"). The sun stands straight above with `angular_radius`.
Scene make_penumbra_oracle(double height, double angular_radius);
/// Visible share of the sun's disk at `x` on the plane (x > 0 is the lit side).
double penumbra_visibility(double height, double angular_radius, double x);

/// All of them on one plane, for pictures: a sphere of 0.5 m whose centre stands 0.6 m high, walls
/// of 1 m and 3 m, a sheet whose straight edge a lamp and the sun shine past, a mirror. The things
/// stand too close together for the formulas above.
Scene make_oracle_box();

}  // namespace kaamos::effects
