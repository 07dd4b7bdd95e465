// SPDX-License-Identifier: MIT
/// @file
/// Scenes whose walls are thinner than the cells of a volume of indirect light. [effects-spec D.2:
/// SC2, SC8]
#pragma once

#include "effects/scene/scene.h"

namespace kaamos::effects {

inline constexpr double kDomeRadius = 5.0;      ///< metres, of the inside
inline constexpr double kOculusRadius = 1.0;    ///< metres, of the opening at the top
inline constexpr double kSealedRoomSize = 2.0;  ///< metres inside, of each room, along each axis

/// What make_thin_dome makes.
struct ThinDomeDesc {
  double thickness = 0.005;  ///< metres, of the shell; 0.0005 to 0.05 is what shows failures
  bool sealed = false;       ///< without the opening: what is inside is black in truth
};

/// A half sphere of 64 x 32 facets over a floor (instances 0, "floor", and 1, "shell"), open at the
/// top; eight ribs that shine lie on its outside. No sun: the inside is lit through the opening
/// alone. The camera stands in the middle and looks at the shell, so that the picture's middle
/// column lies along a meridian.
Scene make_thin_dome(const ThinDomeDesc& desc);

/// What make_sealed_cells makes.
struct SealedCellsDesc {
  double thickness = 0.005;  ///< metres, of all walls
};

/// Nine closed rooms, three by three, a lamp in the middle one, nothing outside: the eight others
/// are black in truth. The first camera looks at the lit room's wall from the room behind it (+z),
/// the second stands in the lit room.
Scene make_sealed_cells(const SealedCellsDesc& desc);

}  // namespace kaamos::effects
