// SPDX-License-Identifier: MIT
// Tables of the report that hold what was measured against what others published.
#pragma once

#include <string>
#include <vector>

#include "effects/assets/image/csv.h"
#include "effects/assets/scene/scene.h"
#include "effects/measure/claims/claims.h"
#include "effects/measure/study/result.h"

namespace kaamos::measure {

struct StudyTable {
  std::string name, title;  // "claims": of its file and its place in the page
  effects::Table cells;
  std::vector<std::string> about;
};

// --claims, and the shape of the survey's Table 1 (Control), which needs the same runs. What an
// earlier run has found is taken from options.out/study.
rtapi::Result<Outcome> study_claims(const Options& options, const effects::Scene& scene,
                                    const Progress& progress, std::vector<StudyTable>& tables);

// The survey's figure 18 from the shadows of the sun; nothing where they were not measured.
std::vector<StudyTable> shadow_tables(const std::vector<StudyResult>& results);

}  // namespace kaamos::measure
