// SPDX-License-Identifier: MIT
// The families of techniques that --study compares, and what it measures of each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "effects/measure/curves/measure.h"

namespace kaamos::measure {

struct StudyFamily {
  std::string name;    // "shadows": of files, and in --families
  std::string title;   // "Shadows of the sun"
  std::string effect;  // the ray traced one, to which the others are alternatives; empty: denoisers
  bool is_sweep = false;  // over one setting; only where --families names it [sweep_plans.h]
};

// A frame in which some settings of a plan are measured.
struct StudyFrame {
  std::function<void(Options& options, effects::Scene& scene)> change;
};

struct StudyPlan {
  MeasurePlan plan;
  std::vector<StudyFrame> frames;  // by MeasuredSetting::frame; empty: that of the options
};

const std::vector<StudyFamily>& study_families();
// The names that --families takes: those, "figure-18", "claims", those of all sweeps, and "sweeps".
std::vector<std::string> study_family_names();

// Every technique of the family, from fast to accurate, or of these only options.rows. `quick`:
// three settings of each at most, and fewer radii. The plan of a sweep, where the family is one.
StudyPlan study_plan(const StudyFamily& family, const Options& options, bool quick);

// The row of a setting as --rows takes it: "gtao/3 slices, 3 steps"; where an effect has several
// techniques, with theirs between.
std::string row_name(const MeasuredSetting& setting);

// Returns what the technique of a plan's group cannot show; empty: nothing but noise.
std::string what_it_misses(const std::string& group);

}  // namespace kaamos::measure
