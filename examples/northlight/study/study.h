// SPDX-License-Identifier: MIT
// northlight --study: every technique of each family, time against error, in one report.
#pragma once

#include "../options.h"
#include "effects/assets/scene/scene.h"
#include "result.h"

namespace northlight {

// Measures the families of options.families and writes study.html, .csv, .json and a plot for each
// family into options.out. Families that an earlier, interrupted study measured are taken from its
// folder `study`.
rtapi::Result<Outcome> run_study(const Options& options, const kaamos::effects::Scene& scene,
                                 const Progress& progress);

}  // namespace northlight
