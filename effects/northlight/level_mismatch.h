// SPDX-License-Identifier: MIT
/// @file
/// Counts what comes of rays that see another level of detail than draws show: surfaces that their
/// own instance's other level shadows. [Northlight deck: Bottom Level Structures]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {

/// Pixels of instances with levels of detail, in the light of the sun.
struct LevelMismatch {
  std::uint64_t pixels = 0;         ///< that show such an instance
  std::uint64_t lit = 0;            ///< of these: rays see the sun through the level that is drawn
  std::uint64_t false_shadows = 0;  ///< of the lit: not through the level that rays see
  std::uint64_t false_light = 0;  ///< of those that are not lit: lit through the level of the rays
};

/// Counts them in the last frame: runs the effect "sun" with the rays' levels and with those of the
/// draws, over the same surfaces. The frame needs that effect, surfaces by draws, and
/// StructureOptions::coarser_rays above 0.
/// @errors KA3046 one of these is not given; those of the device.
rtapi::Result<LevelMismatch> count_level_mismatch(FrameRenderer& renderer);

}  // namespace kaamos::effects
