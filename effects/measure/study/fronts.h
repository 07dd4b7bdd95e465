// SPDX-License-Identifier: MIT
// Measured fronts: what --quality chooses from, of a study, of the source tree, or measured for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/measure/study/family_study.h"

namespace kaamos::measure {

// Results at rest as a small file: with the scene, the machine, the commit and the command; rows
// that were measured, with their times and errors alone.
std::string to_fronts(const Options& options, const std::vector<StudyResult>& results);
// Nothing where the text is no such file.
std::optional<std::vector<StudyResult>> parse_fronts(const std::string& text);

// The question of a family at rest that most techniques answer; null: it was not measured.
const StudyResult* find_result(const StudyFamily& family, const std::vector<StudyResult>& results);

// The results that choices are made from: those of `file`, a study's study.json or fronts.json,
// where it is named; else of options.out/study.json where it has the scene and the backend; else
// those that the source tree has of the scene as it is; else measured quickly, and kept in
// options.out/study. `said` becomes where they are from.
rtapi::Result<Outcome> find_fronts(const Options& options, const std::string& file,
                                   const effects::Scene& scene,
                                   const std::vector<StudyFamily>& families,
                                   const Progress& progress, std::vector<StudyResult>& results,
                                   std::string& said);

}  // namespace kaamos::measure
