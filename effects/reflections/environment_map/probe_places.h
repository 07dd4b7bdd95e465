// SPDX-License-Identifier: MIT
/// @file
/// Where environment maps are seen from: given places, or open ones that are found in the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "effects/engine/effect_pass.h"

namespace kaamos::effects {

/// Those of the scene; where it has none, find_environment_probes.
/// @errors those of find_environment_probes.
rtapi::Result<std::vector<EnvironmentProbe>> environment_probes(const EffectScope& scope,
                                                                std::uint32_t most);

/// Finds places by rays. The camera's room is found, and others that a survey of the scene meets;
/// they share `most` probes, at least 1, and a room is halved along its longest sides into as many
/// cells as it gets. Of a few points of each cell the one with the most room around it is taken.
/// Points that no chain of others joins to the first camera count as inside of something, and those
/// with much more sky around them than the camera has as outside. The box around a probe is the
/// room's: on each side the wall that fills it, or else the scene's end. Only what is baked is
/// seen. Needs as EnvironmentMap::create; u21 and t6 of the scope's views are used meanwhile.
/// @errors those of the device.
rtapi::Result<std::vector<EnvironmentProbe>> find_environment_probes(const EffectScope& scope,
                                                                     std::uint32_t most);

/// One probe where the scene's first camera stands, in the box of the scene: it shows that camera
/// more than a map of the scene can.
EnvironmentProbe camera_probe(const Scene& scene);

}  // namespace kaamos::effects
