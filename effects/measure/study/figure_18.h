// SPDX-License-Identifier: MIT
// The survey's figure 18 beside what is measured here: shadow maps against rays, for one light and
// for four.
#pragma once

#include <vector>

#include "effects/measure/study/result.h"
#include "effects/measure/study/tables.h"

namespace kaamos::measure {

// From the shadows of the sun, for one light; nothing where they were not measured.
std::vector<StudyTable> shadow_tables(const std::vector<StudyResult>& results);

// Makes the table for the sun alone and for four lights, over a traced and over a drawn G-buffer.
// [light_costs.h] What an earlier run has found is taken from options.out/study.
rtapi::Result<Outcome> study_figure_18(const Options& options, const effects::Scene& scene,
                                       const Progress& progress, std::vector<StudyTable>& tables);

}  // namespace kaamos::measure
