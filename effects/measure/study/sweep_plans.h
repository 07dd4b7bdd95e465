// SPDX-License-Identifier: MIT
// Sweeps: what one setting of one technique does to time and error. --families takes their names.
#pragma once

#include <string>
#include <vector>

#include "effects/measure/study/plans.h"

namespace kaamos::measure {

// "sweep-bias" and the others, in the order of the report.
const std::vector<StudyFamily>& study_sweeps();

// The plan of a sweep over single frames. [StudyFamily::is_sweep]
StudyPlan sweep_plan(const StudyFamily& sweep, const Options& options);

}  // namespace kaamos::measure
