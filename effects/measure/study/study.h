// SPDX-License-Identifier: MIT
// northlight --study: every technique of each family, time against error, in one report.
#pragma once

#include "effects/assets/scene/scene.h"
#include "effects/measure/run/frame_result.h"
#include "effects/measure/run/options.h"
#include "effects/measure/study/result.h"

namespace kaamos::measure {

// Measures the families of options.families and writes study.html, .csv, .json and a plot for each
// family into options.out. Families that an earlier, interrupted study measured are taken from its
// folder `study`. `said` becomes what was found.
rtapi::Result<Outcome> run_study(const Options& options, const effects::Scene& scene,
                                 const Progress& progress, std::string& said);

}  // namespace kaamos::measure
