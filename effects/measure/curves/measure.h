// SPDX-License-Identifier: MIT
// northlight --measure EFFECT: time against error over an effect's quality settings.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/assets/image/csv.h"
#include "effects/assets/image/plot.h"
#include "effects/measure/errors/measure_errors.h"
#include "effects/measure/run/effect_runs.h"
#include "effects/measure/run/options.h"

namespace kaamos::measure {

// A setting to measure.
struct MeasuredSetting {
  std::string group;  // settings that differ in one thing only; one line of the plot
  std::string label;
  Setting setting;
  std::string reference;  // name of one of the plan's references
  bool steps = true;      // the group's settings are steps of one scale
  std::size_t frame = 0;  // of StudyPlan::frames
};

// What a row tells besides its errors: names and numbers.
using Also = std::vector<std::pair<std::string, double>>;

struct MeasurePlan {
  std::string title;
  std::string signal;  // the signal to compare
  struct Reference {
    std::string name;   // also of its file
    std::string about;  // what it is
    Setting setting;
    bool light = false;  // radiance, tone mapped for viewing; otherwise a visibility of 0..1
    bool exact = false;  // without noise: one run is enough
  };
  std::vector<Reference> references;
  std::vector<MeasuredSetting> settings;
  std::vector<std::string> effects;  // that run
  bool glass = false;                // only pixels that show glass count
  // What has a path-traced truth is compared with that alone, and references are not rendered.
  bool against_truth = false;
  // Tells more of a setting behind its last run; null: nothing.
  std::function<rtapi::Result<Also>(EffectRuns& runs, const MeasuredSetting& measured,
                                    const effects::FloatImage& image, const Target& target)>
      also = {};
};

// The names that --measure takes, in the order of --help: every effect of the registry that has
// passes of its own, frame and svgf.
std::vector<std::string> measured_effects();
// The default size, at which each effect takes a few minutes on two cores.
std::pair<std::uint32_t, std::uint32_t> default_measure_size(const std::string& effect);
// Returns whether an effect is glass, so that only scenes with glass show it.
bool measures_glass(const std::string& effect);
// Whether it measures shadows of glass, which the truth has on request.
bool measures_panes(const std::string& effect);
// Not for frame and svgf. With options.quick: three settings of each group.
MeasurePlan measure_plan(const Options& options);

// One row of the table.
struct MeasuredRow {
  std::string group, label, reference;
  std::uint32_t rays = 0;  // per pixel, as the setting asks for
  double traced = 0;       // per pixel, including those of hit shading
  double ms = 0;           // median
  double ms_min = 0;
  double ms_max = 0;
  double filter_ms = 0;    // the denoiser's part of ms
  double flicker = -1;     // negative: not measured
  Errors::Summary errors;  // against the effect's own converged result
  double reference_rmse = 0;
  std::optional<Errors::Summary> truth;  // against the path-traced truth
  double truth_rmse = 0;                 // standard error of the truth itself
  bool steps = true;
  Also also;
};

struct MeasuredTable {
  std::string title;
  std::string subtitle;  // scene, size, references, repeats
  std::vector<std::string> about;
  std::vector<MeasuredRow> rows;
  std::string summary;  // printed after the rows; may be empty
};

effects::Table as_csv(const MeasuredTable& table);
std::string as_text(const MeasuredTable& table);
effects::Plot as_plot(const MeasuredTable& table);

// Takes the picture of a setting's last run, what it is compared with, and the truth of that; null:
// there is none.
using LookAt = std::function<rtapi::Status(std::size_t setting, const effects::FloatImage& image,
                                           const Target& target, const Target* truth)>;
// Measures the settings of a plan; fills all of the table but its title.
rtapi::Result<Outcome> run_plan(const MeasurePlan& plan, const Options& options,
                                const effects::Scene& scene, const Progress& progress,
                                MeasuredTable& table, const LookAt& look_at = {});
rtapi::Result<Outcome> measure_effect(const Options& options, const effects::Scene& scene,
                                      const Progress& progress, MeasuredTable& table);
// A denoiser to measure.
struct MeasuredDenoiser {
  std::string label;
  effects::DenoiseDesc desc;
  bool is_step = false;  // of a scale that another one stands for
};
// Its technique and its setting as tables have them: "svgf by passes", "3 passes".
std::pair<std::string, std::string> denoiser_names(const std::string& label);
// Those of --measure svgf.
std::vector<MeasuredDenoiser> measured_denoisers();
// `look_at` gets the last frames of the last seed, with the number of the row in the table.
rtapi::Result<Outcome> measure_denoisers(
    const Options& options, const effects::Scene& scene, const Progress& progress,
    MeasuredTable& table, const LookAt& look_at = {},
    const std::vector<MeasuredDenoiser>& denoisers = measured_denoisers());

rtapi::Result<Outcome> measure_frame(const Options& options, const effects::Scene& scene,
                                     const Progress& progress, MeasuredTable& table);

// Measures, and writes measure-EFFECT.csv and .svg into options.out; `said` becomes the table as
// text. References are kept in its folder measure-cache.
rtapi::Result<Outcome> run_measure(const Options& options, const effects::Scene& scene,
                                   const Progress& progress, std::string& said);

// "lounge, 320 x 180, embree".
std::string scene_text(const Options& options);
// The middle value; for an even number of values, the lower of the middle two.
double median(std::vector<double> values);

}  // namespace kaamos::measure
