// SPDX-License-Identifier: MIT
// northlight --quality and --budget: the techniques of a frame, chosen from what was measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "effects/measure/study/plans.h"
#include "effects/measure/study/result.h"

namespace kaamos::measure {

// From fast to accurate.
enum class Quality { kLow, kMedium, kHigh, kUltra };

// "low", "medium", "high", "ultra".
const std::vector<std::string>& quality_names();

// What is wanted of a frame: a quality, or the least error within a time.
struct QualityGoal {
  Quality quality = Quality::kHigh;
  std::optional<double> budget_ms;  // of the effects' passes together
};

// A technique with its settings for one family.
struct QualityChoice {
  StudyFamily family;
  std::string effect;  // of the registry
  effects::EffectSettings settings;
  std::string name;  // "ground-truth ambient occlusion, 3 slices, 3 steps"
  double ms = 0;     // as measured, times the frame's pixels over those measured
  double error = 0;  // as measured: before any denoiser
  std::string why;   // what makes it the choice
};

// The families that a frame of these options renders in this scene.
std::vector<StudyFamily> quality_families(const Options& options, const effects::Scene& scene);

// Chooses for each of the families that `results` have a measurement of, at rest. Settings that no
// frame can take, such as the volume times ambient occlusion, do not count. Of several questions
// the one counts that most techniques answer.
//
// Low: of what traces no rays, the fastest whose error is at most twice the least of such, unless
// something with rays is both faster and nearer to the truth [survey 8]. Ultra: the least error.
// Between them, the fastest whose error is at most a third, or two thirds, of the way between the
// ends of the Pareto front, by ratios. A budget: the least sum of squared errors; where nothing is
// fast enough, the fastest of each.
std::vector<QualityChoice> choose_quality(const QualityGoal& goal, const Options& options,
                                          const std::vector<StudyFamily>& families,
                                          const std::vector<StudyResult>& results);

// Puts them into the frame, in the place of what it had for these families.
void apply_quality(const std::vector<QualityChoice>& choices, Options& options);

// A line for each, with its time, its error and why.
std::string quality_text(const QualityGoal& goal, const std::vector<QualityChoice>& choices);

// The results that choices are made from: those of `file`, a study's study.json, where it is named;
// else of options.out/study.json where it has the scene and the backend; else measured quickly, and
// kept in options.out/study. `said` becomes where they are from.
rtapi::Result<Outcome> find_fronts(const Options& options, const std::string& file,
                                   const effects::Scene& scene,
                                   const std::vector<StudyFamily>& families,
                                   const Progress& progress, std::vector<StudyResult>& results,
                                   std::string& said);

}  // namespace kaamos::measure
