// SPDX-License-Identifier: MIT
// Which layers of the path-traced truth an effect's signal is held against.
#pragma once

#include <optional>

#include "effect_runs.h"
#include "effects/reference/path_sums.h"
#include "measure_errors.h"

namespace northlight {

// The truth of what EffectRuns::read returns for the setting; none: the truth has no such signal.
// Runs what the setting stands in front of, for glass.
rtapi::Result<std::optional<Target>> truth_of(EffectRuns& runs, const Setting& setting,
                                              const kaamos::effects::PathSums& truth);

}  // namespace northlight
