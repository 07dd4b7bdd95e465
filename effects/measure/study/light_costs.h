// SPDX-License-Identifier: MIT
// What the shadows of the sun and of three lamps take by each technique of the survey's figure 18.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "effects/measure/run/frame_result.h"

namespace kaamos::measure {

// Lamps that stand beside the sun in the case of four lights.
inline constexpr std::size_t kLampsBesideTheSun = 3;

struct LightTechnique {
  std::string name;   // as the survey calls it, where it has it
  std::string label;  // the setting here
  bool has_map = false;
};
// In the order of the figure; the second is its unit, hard rays.
const std::vector<LightTechnique>& light_techniques();
inline constexpr std::size_t kHardRays = 1;

// Of one technique.
struct LightCost {
  double sun_ms = 0;
  double lamps_ms = 0;                  // of all three, their maps included
  double sun_error = 0, all_error = 0;  // RMSE against many rays: of the sun's, of all four
};

// Over one G-buffer.
struct LightCosts {
  double surfaces_ms = 0;  // the G-buffer itself
  double map_ms = 0;       // of a lamp
  std::size_t lamps = 0;   // that were measured: kLampsBesideTheSun, or none
  std::vector<LightCost> by_technique;
};

// Medians of options.repeats frames of a sequence at rest. The lamps are those nearest to the
// camera; a scene with fewer has none measured. The scene must have a sun.
rtapi::Result<Outcome> measure_lights(const Options& options, const effects::Scene& scene,
                                      effects::Primary primary, const Progress& progress,
                                      LightCosts& costs);

}  // namespace kaamos::measure
