// SPDX-License-Identifier: MIT
#include "effects/measure/curves/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/measure/errors/measure_reference.h"
#include "effects/measure/run/failure.h"
#include "effects/measure/truth/measure_truth.h"
#include "effects/measure/truth/truth.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

std::string cache_folder(const Options& options) {
  return options.out + "/measure-cache";
}

// The frame of a sequence in which effects with a history are measured: by then it has settled.
constexpr std::uint32_t kSettled = 7;

bool has_history(const MeasuredSetting& measured) {
  return find_effect(northlight_effects(), measured.setting.effect)->has_history;
}

// Runs all that have a history over the frames of a sequence before the one that is measured.
rtapi::Status settle(EffectRuns& runs, const MeasurePlan& plan) {
  if (std::none_of(plan.settings.begin(), plan.settings.end(), has_history)) return {};
  for (std::uint32_t frame = 0; frame < kSettled; ++frame) {
    if (const auto s = runs.begin_frame(frame); !s) return s;
    for (const MeasuredSetting& measured : plan.settings) {
      if (!has_history(measured)) continue;
      if (const auto ran = runs.run(in_frame(measured.setting, frame)); !ran) return ran.error();
    }
  }
  return runs.begin_frame(kSettled);
}

// The results of one run of a setting.
struct Record {
  std::vector<double> ms;
  double traced = 0;
  Errors errors;
  Errors from_truth;
  Also also;
};

rtapi::Result<FloatImage> run_setting(EffectRuns& runs, const Setting& setting,
                                      const Target& target, const Target* truth, Record& record) {
  const auto ran = runs.run(setting);
  if (!ran) return ran.error();
  record.ms.push_back(ran->ms);
  const Frame& frame = runs.renderer().frame();
  record.traced = static_cast<double>(ran->rays) / frame.width() / frame.height();
  const auto image = runs.read(setting);
  if (!image) return image.error();
  if (const auto error = record.errors.add(*image, target); !error.empty()) return failure(error);
  if (truth == nullptr) return image;
  if (const auto error = record.from_truth.add(*image, *truth); !error.empty()) {
    return failure(error);
  }
  return image;
}

rtapi::Result<Outcome> make_target(EffectRuns& runs, const MeasurePlan& plan,
                                   const MeasurePlan::Reference& reference, const Options& options,
                                   const Progress& progress, Target& target) {
  if (reference.exact) {
    if (const auto ran = runs.run(reference.setting); !ran) return ran.error();
    const auto image = runs.read(reference.setting);
    if (!image) return image.error();
    const auto mask = runs.mask(plan.glass);
    if (!mask) return mask.error();
    target.image = *image;
    target.mask = *mask;
    if (std::find(mask->begin(), mask->end(), 1) == mask->end()) {
      return failure(
          "no pixel shows glass: choose another scene, such as glass-stack, or turn a "
          "material into glass, as in --material NAME:alpha=0.3,roughness=0");
    }
  } else {
    const auto made = make_reference(runs, reference.setting, options.measure_reference,
                                     reference.name, cache_folder(options), progress, target);
    if (!is_done(made)) return made;
  }
  if (reference.light) target.exposure = runs.renderer().context().scene.exposure;
  return Outcome::kDone;
}

// The pictures that the settings of a reference are compared with.
struct Compared {
  Target target;
  std::optional<Target> truth;
};

void apply_mask(const std::vector<std::uint8_t>& mask, Target& target) {
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) target.mask[i] = 0;
  }
}

// `sums`: null where there is no truth.
rtapi::Result<Outcome> make_compared(EffectRuns& runs, const MeasurePlan& plan,
                                     const MeasurePlan::Reference& reference,
                                     const Options& options, const PathSums* sums,
                                     const Progress& progress, Compared& out,
                                     std::vector<std::string>& about) {
  const auto find_truth = [&]() -> rtapi::Status {
    if (sums == nullptr) return {};
    auto truth = truth_of(runs, reference.setting, *sums);
    if (!truth) return truth.error();
    out.truth = std::move(*truth);
    return {};
  };
  if (plan.against_truth) {
    if (const auto s = find_truth(); !s) return s.error();
  }
  if (plan.against_truth && out.truth) {
    // Any run draws the surfaces.
    if (const auto ran = runs.run(reference.setting); !ran) return ran.error();
    const auto mask = runs.mask(plan.glass);
    if (!mask) return mask.error();
    apply_mask(*mask, *out.truth);
    if (reference.light) out.truth->exposure = runs.renderer().context().scene.exposure;
    out.target = *out.truth;
  } else {
    const auto made = make_target(runs, plan, reference, options, progress, out.target);
    if (!is_done(made)) return made;
    about.push_back(fmt::format("reference {}: {}, {}", reference.name, reference.about,
                                reference.exact
                                    ? std::string("exact")
                                    : fmt::format("{} samples, its own RMSE {:.2g}",
                                                  options.measure_reference, out.target.own_rmse)));
    if (const auto s = find_truth(); !s) return s.error();
    if (out.truth) {
      out.truth->exposure = out.target.exposure;
      apply_mask(out.target.mask, *out.truth);
    }
  }
  if (out.truth) {
    about.push_back(fmt::format("truth of {}: path-traced, {} samples, its own RMSE {:.2g}",
                                reference.name, sums->samples[0] + sums->samples[1],
                                out.truth->own_rmse));
  }
  return Outcome::kDone;
}

std::string clock_text(const Options& options) {
  return options.cpu_clock ? ", CPU time over threads" : "";
}

}  // namespace

std::string scene_text(const Options& options) {
  std::string text = fmt::format("{}, {} x {}, {}", options.scene, options.frame.width,
                                 options.frame.height, options.backend);
  if (options.threads > 0) text += fmt::format(", {} threads", options.threads);
  return text;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

rtapi::Result<Outcome> measure_effect(const Options& options, const Scene& scene,
                                      const Progress& progress, MeasuredTable& table) {
  const MeasurePlan plan = measure_plan(options);
  const EffectNeeds& needs = find_effect(northlight_effects(), options.measure)->needs;
  if (needs.sun && !scene.sun) return failure("the scene has no sun to measure");
  if (needs.strongest_lights && count_local_lights(scene) == 0) {
    return failure("the scene has no local light to measure");
  }
  table.title = plan.title + ": time against error";
  return run_plan(plan, options, scene, progress, table);
}

rtapi::Result<Outcome> run_plan(const MeasurePlan& plan, const Options& options, const Scene& scene,
                                const Progress& progress, MeasuredTable& table,
                                const LookAt& look_at) {
  std::unique_ptr<EffectRuns> runs;
  const auto created = EffectRuns::create(options, scene, plan.effects, cache_folder(options),
                                          progress, options.say, runs);
  if (!is_done(created)) return created;
  table.subtitle = fmt::format("{}; {}; median of {} interleaved runs{}", scene_text(options),
                               plan.signal, options.repeats, clock_text(options));
  PathSums sums;
  if (options.measure_truth > 0) {
    const auto traced = trace_truth(options, scene, cache_folder(options), progress, sums);
    if (!is_done(traced)) return traced;
  }
  std::map<std::string, Compared> compared;  // by reference
  for (const auto& reference : plan.references) {
    const auto made =
        make_compared(*runs, plan, reference, options, options.measure_truth > 0 ? &sums : nullptr,
                      progress, compared[reference.name], table.about);
    if (!is_done(made)) return made;
  }
  const auto truth_for = [&](const MeasuredSetting& measured) -> const Target* {
    const Compared& with = compared.at(measured.reference);
    return with.truth ? &*with.truth : nullptr;
  };
  // One uncounted run of everything first, which warms up pipelines and caches.
  std::vector<Record> records(plan.settings.size());
  for (std::uint32_t repeat = 0; repeat <= options.repeats; ++repeat) {
    if (const auto s = runs->set_seed(options.frame.seed + repeat); !s) return s.error();
    if (const auto s = settle(*runs, plan); !s) return s.error();
    if (repeat == 1) records.assign(plan.settings.size(), {});
    for (std::size_t i = 0; i < records.size(); ++i) {
      const MeasuredSetting& measured = plan.settings[i];
      const Target& target = compared.at(measured.reference).target;
      const Target* truth = truth_for(measured);
      const Setting now =
          has_history(measured) ? in_frame(measured.setting, kSettled) : measured.setting;
      const auto image = run_setting(*runs, now, target, truth, records[i]);
      if (!image) return image.error();
      if (plan.also && repeat == options.repeats) {
        auto also = plan.also(*runs, measured, *image, target);
        if (!also) return also.error();
        records[i].also = std::move(*also);
      }
      if (look_at && repeat == options.repeats) {
        if (const auto s = look_at(i, *image, target, truth); !s) return s.error();
      }
      const double done =
          (repeat + (i + 1.0) / static_cast<double>(records.size())) / (options.repeats + 1.0);
      if (!progress("measuring", done)) return Outcome::kStopped;
    }
  }
  for (std::size_t i = 0; i < records.size(); ++i) {
    const MeasuredSetting& measured = plan.settings[i];
    const Target& target = compared.at(measured.reference).target;
    MeasuredRow row{measured.group, measured.label, measured.reference};
    row.rays = std::max(measured.setting.settings.samples, measured.setting.times_ao);
    if (plan.glass) row.rays = 1;
    row.traced = records[i].traced;
    row.ms = median(records[i].ms);
    row.ms_min = *std::min_element(records[i].ms.begin(), records[i].ms.end());
    row.ms_max = *std::max_element(records[i].ms.begin(), records[i].ms.end());
    row.errors = records[i].errors.summary(target);
    row.reference_rmse = target.own_rmse;
    if (const Target* truth = truth_for(measured)) {
      row.truth = records[i].from_truth.summary(*truth);
      row.truth_rmse = truth->own_rmse;
      // The truth's own noise is no bias of the effect.
      row.truth->bias_squared -= row.truth_rmse * row.truth_rmse;
    }
    row.steps = measured.steps;
    row.also = records[i].also;
    table.rows.push_back(row);
  }
  return Outcome::kDone;
}

Table as_csv(const MeasuredTable& table) {
  Table out;
  out.columns = {"group",
                 "setting",
                 "rays",
                 "traced_rays",
                 "ms",
                 "ms_min",
                 "filter_ms",
                 "rmse",
                 "rel_mse",
                 "trimmed_rel_mse",
                 "psnr_db",
                 "ssim",
                 "flip",
                 "energy_ratio",
                 "bias_squared",
                 "variance",
                 "flicker",
                 "not_finite",
                 "reference",
                 "reference_rmse",
                 "truth_rmse",
                 "truth_rel_mse",
                 "truth_ssim",
                 "truth_flip",
                 "truth_energy_ratio",
                 "truth_bias_squared",
                 "truth_own_rmse"};
  for (const MeasuredRow& row : table.rows) {
    const Errors::Summary& e = row.errors;
    out.rows.push_back({row.group,
                        row.label,
                        std::to_string(row.rays),
                        csv_number(row.traced),
                        csv_number(row.ms),
                        csv_number(row.ms_min),
                        csv_number(row.filter_ms),
                        csv_number(e.rmse),
                        csv_number(e.relative_mse),
                        csv_number(e.trimmed_relative_mse),
                        csv_number(e.psnr),
                        csv_number(e.ssim),
                        csv_number(e.flip),
                        csv_number(e.energy_ratio),
                        csv_number(e.bias_squared),
                        csv_number(e.variance),
                        row.flicker < 0 ? "" : csv_number(row.flicker),
                        std::to_string(e.not_finite),
                        row.reference,
                        csv_number(row.reference_rmse)});
    const auto add = [&](double Errors::Summary::*value) {
      out.rows.back().push_back(row.truth ? csv_number((*row.truth).*value) : "");
    };
    for (const auto value :
         {&Errors::Summary::rmse, &Errors::Summary::relative_mse, &Errors::Summary::ssim,
          &Errors::Summary::flip, &Errors::Summary::energy_ratio, &Errors::Summary::bias_squared}) {
      add(value);
    }
    out.rows.back().push_back(row.truth ? csv_number(row.truth_rmse) : "");
  }
  return out;
}

std::string as_text(const MeasuredTable& table) {
  std::string out = fmt::format("{}\n{}\n", table.title, table.subtitle);
  for (const std::string& line : table.about) out += line + "\n";
  std::string group;
  for (const MeasuredRow& row : table.rows) {
    if (row.group != group) {
      group = row.group;
      out += fmt::format(
          "\n{}\n{:<28}{:>5}{:>9}{:>9}{:>9}{:>10}{:>10}{:>8}{:>8}{:>8}{:>8}{:>10}{:>10}{}\n", group,
          "", "rays", "traced", "ms", "ms min", "RMSE", "relMSE", "PSNR", "SSIM", "FLIP", "energy",
          "bias^2", "variance", row.truth ? "  | truth: RMSE    FLIP  energy    bias^2" : "");
    }
    const Errors::Summary& e = row.errors;
    out += fmt::format(
        "{:<28}{:>5}{:>9.2f}{:>9.2f}{:>9.2f}{:>10.3g}{:>10.3g}{:>8.2f}{:>8.4f}{:>8.4f}{:>8.4f}{:>"
        "10.2e}{:>"
        "10.2e}",
        row.label, row.rays, row.traced, row.ms, row.ms_min, e.rmse, e.relative_mse, e.psnr, e.ssim,
        e.flip, e.energy_ratio, e.bias_squared, e.variance);
    if (row.truth) {
      out += fmt::format("  | {:>11.3g}{:>8.4f}{:>8.4f}{:>10.2e}", row.truth->rmse, row.truth->flip,
                         row.truth->energy_ratio, row.truth->bias_squared);
    }
    if (row.flicker >= 0) out += fmt::format("  flicker {:.4f}", row.flicker);
    if (e.not_finite > 0) out += fmt::format("  {} values are not finite", e.not_finite);
    out += "\n";
  }
  return out + table.summary;
}

Plot as_plot(const MeasuredTable& table) {
  Plot plot{.title = table.title,
            .subtitle = table.subtitle,
            .x_label = "time (ms)",
            .y_label = "root mean square error"};
  std::set<double> levels;
  for (const MeasuredRow& row : table.rows) {
    if (plot.series.empty() || plot.series.back().name != row.group) {
      plot.series.push_back({row.group, {}, row.steps});
    }
    plot.series.back().points.push_back({row.ms, row.errors.rmse, row.label});
    if (row.reference_rmse > 0 && levels.insert(row.reference_rmse).second) {
      plot.levels.push_back({"own error of reference " + row.reference, row.reference_rmse});
    }
  }
  return plot;
}

rtapi::Result<Outcome> run_measure(const Options& options, const Scene& scene,
                                   const Progress& progress, std::string& said) {
  std::error_code failed;
  std::filesystem::create_directories(cache_folder(options), failed);
  if (failed) {
    return failure(
        fmt::format("cannot make the folder {}: {}", cache_folder(options), failed.message()));
  }
  MeasuredTable table;
  const auto measured =
      options.measure == "svgf"    ? measure_denoisers(options, scene, progress, table)
      : options.measure == "frame" ? measure_frame(options, scene, progress, table)
                                   : measure_effect(options, scene, progress, table);
  if (!is_done(measured)) return measured;
  const std::string path = options.out + "/measure-" + options.measure;
  if (const auto s = write_text(path + ".csv", write_csv(as_csv(table))); !s) return s.error();
  if (const auto s = write_text(path + ".svg", plot_svg(as_plot(table))); !s) return s.error();
  said = fmt::format("{}\nwrote {}.csv and .svg\n", as_text(table), path);
  return Outcome::kDone;
}

}  // namespace kaamos::measure
