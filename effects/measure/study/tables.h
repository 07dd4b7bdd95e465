// SPDX-License-Identifier: MIT
// Tables of the report that hold what was measured against what others published.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "effects/assets/image/csv.h"
#include "effects/assets/scene/scene.h"
#include "effects/measure/claims/claims.h"

namespace kaamos::measure {

struct StudyTable {
  std::string name, title;  // "claims": of its file and its place in the page
  effects::Table cells;
  std::vector<std::string> about;
};

// The tables of an earlier run from a file, else those that `make` makes, which are then kept
// there.
using MakeTables = std::function<rtapi::Result<Outcome>(std::vector<StudyTable>& tables)>;
rtapi::Result<Outcome> kept_tables(const std::string& file, const std::string& key,
                                   const MakeTables& make, std::vector<StudyTable>& tables);
// Of all that tables depend on.
std::string tables_key(const Options& options, const effects::Scene& scene);

// --claims, and the shape of the survey's Table 1 (Control), which needs the same runs. What an
// earlier run has found is taken from options.out/study.
rtapi::Result<Outcome> study_claims(const Options& options, const effects::Scene& scene,
                                    const Progress& progress, std::vector<StudyTable>& tables);

}  // namespace kaamos::measure
