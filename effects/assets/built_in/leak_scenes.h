// SPDX-License-Identifier: MIT
/// @file
/// Scenes that are dark inside, where a volume of indirect light may let light in: through walls
/// that are thinner than its cells, or in the middle of a room that is much larger than them.
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

inline constexpr double kDomeRadius = 5.0;      ///< metres, of the inside
inline constexpr double kOculusRadius = 1.0;    ///< metres, of the opening at the top
inline constexpr double kSealedRoomSize = 2.0;  ///< metres inside, of each room, along each axis

/// The parameters of make_thin_dome.
struct ThinDomeDesc {
  double thickness = 0.005;  ///< metres, of the shell; 0.0005 to 0.05 is what shows failures
  bool sealed = false;       ///< without the opening: what is inside is black in truth
};

/// A half sphere of 64 x 32 facets over a floor (instances 0, "floor", and 1, "shell"), open at the
/// top; eight ribs that shine lie on its outside. No sun: the inside is lit through the opening
/// alone. The camera stands in the middle and looks at the shell, so that the picture's middle
/// column lies along a meridian.
Scene make_thin_dome(const ThinDomeDesc& desc);

/// The parameters of make_sealed_cells.
struct SealedCellsDesc {
  double thickness = 0.005;  ///< metres, of all walls
};

/// Nine closed rooms, three by three, a lamp in the middle one, nothing outside: the eight others
/// are black in truth. The first camera looks at the lit room's wall from the room behind it (+z),
/// the second stands in the lit room.
Scene make_sealed_cells(const SealedCellsDesc& desc);

inline constexpr glm::dvec3 kHallSize{24, 12, 24};  ///< metres inside of the sealed hall
inline constexpr double kHallWall = 0.3;            ///< metres, thickness of its walls
inline constexpr float kHallAlbedo = 0.7f;          ///< of everything in it
inline constexpr float kHallLamp = 600.0f;          ///< candela, of the lamp in the lit one

/// The parameters of make_sealed_hall.
struct SealedHallDesc {
  bool lit = false;  ///< a lamp hangs in it
};

/// A closed hall on the ground, about the origin, under a bright sky and a sun. Without a lamp it
/// is black in truth. With one, what its surfaces get from each other is known on average: all that
/// the lamp sends out is absorbed in the end, so the irradiance is flux / (area * (1 - albedo)), of
/// which flux / area comes from the lamp itself.
Scene make_sealed_hall(const SealedHallDesc& desc);

}  // namespace kaamos::effects
