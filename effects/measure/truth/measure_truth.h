// SPDX-License-Identifier: MIT
// Makes the truth of an effect's signal from layers of the path-traced truth.
#pragma once

#include <optional>

#include "effects/measure/errors/measure_errors.h"
#include "effects/measure/run/effect_runs.h"
#include "effects/reference/path_sums.h"

namespace kaamos::measure {

// The truth of what EffectRuns::read returns for the setting; none: the truth has no such signal.
// Runs what the setting stands in front of, for glass.
rtapi::Result<std::optional<Target>> truth_of(EffectRuns& runs, const Setting& setting,
                                              const effects::PathSums& truth);

}  // namespace kaamos::measure
