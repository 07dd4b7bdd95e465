// SPDX-License-Identifier: MIT
// northlight --quality and --budget: the techniques of a frame, chosen from what was measured.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "effects/measure/study/frame_ways.h"
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

// A technique with its settings for one family, or a way to make the frame.
struct QualityChoice {
  StudyFamily family;
  std::string effect;                // of the registry; empty: a choice about the whole frame
  effects::EffectSettings settings;  // of the effect
  std::function<void(Options& options)> change = {};  // of the frame, where there is no effect
  std::string option;  // "--effects gtao", "--denoise svgf"; empty: as frames are by default
  std::string name;    // "ground-truth ambient occlusion, 3 slices, 3 steps"
  double ms = 0;       // as measured, for the frame's pixels; of whole frames what it takes more
  double error = 0;    // as measured: of effects before any denoiser
  std::string why;     // what makes it the choice
};

// The families that a frame of these options has in this scene. Lamps' shadows are one question,
// which contact shadows answer beside others.
std::vector<StudyFamily> quality_families(const Options& options, const effects::Scene& scene);

// The setting of a family that a measured row is of: null where no frame can take it, or where it
// is none any more.
const MeasuredSetting* find_measured(const MeasurePlan& plan, const StudyRow& row);
// The denoiser of a row, or the way to make a frame. Null: it is none any more.
///@{
const MeasuredDenoiser* find_denoiser(const StudyRow& row);
const FrameWay* find_way(const std::string& family, const StudyRow& row);
///@}

// Chooses for each of the families that `results` have a measurement of, at rest. Settings that no
// frame can take, such as the volume times ambient occlusion, do not count; nor does in a still
// what needs a sequence. Of several questions the one counts that most techniques answer. Times are
// those that a row takes whatever the picture's size is, and the rest of it by pixels. Of denoisers
// the error is the root of the mean square over the signals, and the time that of their filters.
//
// Low: of what traces no rays, the fastest whose error is at most twice the least of such, unless
// something with rays is both faster and nearer to the truth [survey 8]. Ultra: the least error.
// Between them, the fastest whose error is at most a third, or two thirds, of the way between the
// ends of the Pareto front, by ratios. What is no effect takes no rays of its own: low is then the
// fastest whose error is at most twice the least. A budget: the least sum of squared errors; where
// nothing is fast enough, the fastest of each.
std::vector<QualityChoice> choose_quality(const QualityGoal& goal, const Options& options,
                                          const std::vector<StudyFamily>& families,
                                          const std::vector<StudyResult>& results);

// Puts them into the frame, in the place of what it had for these families.
void apply_quality(const std::vector<QualityChoice>& choices, Options& options);

// A line for each, with its time, its error and why.
std::string quality_text(const QualityGoal& goal, const std::vector<QualityChoice>& choices);

}  // namespace kaamos::measure
