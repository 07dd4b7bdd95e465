// SPDX-License-Identifier: MIT
/// @file
/// Thin things that stand on a floor, where the bias of a shadow map shows: too small, and lit
/// floor is speckled (acne); too large, and shadows come loose from what casts them (peter
/// panning). All of it is known in closed form.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The parameters of make_peter_panning. The sun stands over +x, so that shadows fall towards -x.
struct PeterPanningDesc {
  double sun_elevation = 0.45;  ///< radians over the horizon; 0.052 (3 degrees) to 1.4
  double angular_radius = kSunAngularRadius;  ///< radians, of the sun; 0: hard shadows
};

/// Three stools with legs of 5, 10 and 30 mm diameter, a plank that leaves the floor along an edge
/// like the sole of a shoe, and two sheets at different heights, whose shadows end on one line of
/// the floor: over the first third of it the lower one alone, over the last the higher one alone,
/// over the middle both. Instance 0 is the floor y = 0. The second camera stands before a foot.
Scene make_peter_panning(const PeterPanningDesc& desc);

/// A leg of a stool: an upright cylinder from the floor to the seat.
struct StoolLeg {
  double radius;  ///< metres
  glm::dvec2 at;  ///< x and z of its axis
};
/// The twelve legs, thin ones first.
std::span<const StoolLeg> stool_legs();

/// The light at a point of the floor.
enum class FloorLight : std::uint8_t {
  kLit,     ///< all around the point sees the sun's middle
  kShadow,  ///< nothing around it does
  kEdge,    ///< closer to the edge of a shadow than the margin, or below a thing
};
/// For the point (x, z) of the floor; `margin` in metres.
FloorLight floor_light(const PeterPanningDesc& desc, const glm::dvec2& point, double margin);
/// Returns whether the floor's point (x, z) sees the sun's middle.
bool sees_sun(const PeterPanningDesc& desc, const glm::dvec2& point);

/// Returns the point in the middle of a leg's shadow that is `distance` metres from the leg: floor
/// x and z. A technique's shadow comes loose by the distance over which it is lit there (the gap; 0
/// in truth). For the six legs with at.x > 0, below an elevation of 1 radian and up to 0.25 m, no
/// other shadow lies there.
glm::dvec2 shadow_middle(const StoolLeg& leg, double distance);

/// The line where the sheets' shadows end (x), and the middle z of its three parts: the lower sheet
/// alone, both, the higher one alone.
///@{
inline constexpr double kSheetShadowX = -0.6;
inline constexpr double kSheetPartZ[3] = {-1.5, -2.1, -2.7};
///@}
inline constexpr double kSheetHeights[2] = {0.25, 1.0};  ///< metres, of the sheets' upper sides
/// Visible share of the sun at the floor's point `x` of a part's middle (0, 1, 2): the straight
/// edges of both sheets are parallel, so that the sheet that covers more of the sun decides.
double sheet_visibility(const PeterPanningDesc& desc, int part, double x);

}  // namespace kaamos::effects
