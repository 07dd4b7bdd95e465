// SPDX-License-Identifier: MIT
#include "effects/measure/study/family_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/assets/image/png.h"
#include "effects/measure/run/failure.h"
#include "effects/measure/run/picture_key.h"
#include "effects/measure/study/files.h"
#include "effects/measure/study/findings.h"
#include "effects/measure/study/frame_ways.h"
#include "effects/measure/study/motion.h"
#include "effects/measure/study/sweep_lag.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr std::uint32_t kVulkanPart = 4;  // of the width and height
constexpr float kShownDifference = 4;

// Takes floats from 0 to 1; pixels that the mask leaves out become grey.
ByteImage as_bytes(const FloatImage& image, const std::vector<std::uint8_t>& mask) {
  ByteImage out{image.width, image.height, 3, std::vector<std::uint8_t>(image.values.size())};
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const float value = mask[i / 3] != 0 ? std::clamp(image.values[i], 0.0f, 1.0f) : 0.5f;
    out.values[i] = static_cast<std::uint8_t>(std::lround(value * 255));
  }
  return out;
}

FloatImage difference(const FloatImage& a, const FloatImage& b) {
  FloatImage out(a.width, a.height, 3);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = kShownDifference * std::abs(a.values[i] - b.values[i]);
  }
  return out;
}

class PartStudy {
 public:
  PartStudy(const StudyPart& part, const Options& options, const Scene& scene)
      : part_(part),
        options_(options_of(part, options)),
        scene_(scene),
        folder_(options.out + "/study") {
    if (part.family.effect.empty()) return;
    StudyPlan planned = study_plan(part.family, options_, options.quick);
    plan_ = std::move(planned.plan);
    frames_ = std::move(planned.frames);
  }

  rtapi::Result<Outcome> run(const Progress& progress, std::vector<StudyResult>& results) {
    const std::string file = folder_ + "/" + part_.name() + ".json";
    const auto kept = parse_results(read_text(file));
    if (kept && !kept->empty() && kept->front().key == key()) {
      results.insert(results.end(), kept->begin(), kept->end());
      return Outcome::kDone;
    }
    std::vector<StudyResult> found;
    const auto done = measure(progress, found);
    if (!is_done(done)) return done;
    for (StudyResult& result : found) result.key = key();
    if (const auto s = write_text(file, to_json(found)); !s) return s.error();
    results.insert(results.end(), found.begin(), found.end());
    return Outcome::kDone;
  }

 private:
  // Vulkan runs a sixteenth of the pixels, as for the claims; what moves a quarter, with half of
  // the truth's samples.
  static Options options_of(const StudyPart& part, const Options& options) {
    Options out = options;
    out.backend = part.backend;
    out.glass_shadows = measures_panes(part.family.effect);
    const auto shrink = [&](std::uint32_t by) {
      out.frame.width = std::max(options.frame.width / by, 1u);
      out.frame.height = std::max(options.frame.height / by, 1u);
    };
    if (part.is_smaller) shrink(kVulkanPart);
    if (!part.moves || part.family.effect.empty()) return out;
    if (!part.is_smaller) shrink(2);
    out.measure_truth = std::max(options.measure_truth / 2, 2u);
    return out;
  }

  // Returns the key of the kept numbers: it covers the picture and the way it was measured.
  std::string key() const {
    Checksum checksum;
    checksum.add(picture_key(options_, scene_));
    for (const std::uint32_t number :
         {options_.repeats, options_.measure_reference, options_.measure_truth, options_.seeds}) {
      checksum.add_value(number);
    }
    checksum.add_value(options_.cpu_clock);
    checksum.add(options_.committed);
    for (const MeasuredSetting& each : plan_.settings) {
      checksum.add(each.group);
      checksum.add(each.label);
      add_setting(checksum, each.setting);
    }
    return as_key(checksum);
  }

  StudyResult begin_result(const std::string& name, const std::string& title) const {
    StudyResult out;
    out.family = name;
    out.title = title;
    out.scene = options_.scene;
    out.backend = options_.backend;
    out.width = options_.frame.width;
    out.height = options_.frame.height;
    if (part_.moves) out.title += ", in motion";
    if (part_.is_smaller) out.title += ", " + part_.backend;
    return out;
  }

  // A result for each question that the family answers: settings that are compared with the same.
  // Only ambient occlusion has several, by radius.
  void begin_results(std::vector<StudyResult>& results) {
    const bool is_split = part_.family.name == "ao";
    for (const MeasuredSetting& each : plan_.settings) {
      const bool is_first = !is_split || each.reference == plan_.references.front().name;
      const std::string question = is_first ? "" : each.reference.substr(each.reference.find('-'));
      const std::string name = part_.name(question);
      auto found = std::find_if(results.begin(), results.end(),
                                [&](const StudyResult& result) { return result.family == name; });
      if (found == results.end()) {
        results.push_back(begin_result(name, part_.family.title));
        found = results.end() - 1;
        if (is_split) {
          found->title += fmt::format(" within {:g} m", each.setting.settings.radius);
        }
      }
      places_.emplace_back(found - results.begin(), found->rows.size());
      found->rows.push_back(begin_row(each));
    }
  }

  StudyRow& row_of(std::size_t setting, std::vector<StudyResult>& results) const {
    const auto& [result, row] = places_[setting];
    return results[result].rows[row];
  }

  rtapi::Result<Outcome> measure(const Progress& progress, std::vector<StudyResult>& results) {
    if (part_.family.name == "sweep-lag-switch") {
      return measure_lag_of(LagCause::kSwitch, progress, results);
    }
    if (part_.family.name == "sweep-lag-move") {
      return measure_lag_of(LagCause::kMove, progress, results);
    }
    if (!frame_ways(part_.family.name).empty()) return measure_ways(progress, results);
    if (part_.family.effect.empty()) return measure_filters(progress, results);
    begin_results(results);
    if (results.empty()) return Outcome::kDone;
    if (const std::string missing = why_missing(); !missing.empty()) {
      for (StudyResult& result : results) {
        for (StudyRow& row : result.rows) row.missing = missing;
      }
      return Outcome::kDone;
    }
    pictures_.resize(places_.size());
    for (std::size_t frame = 0; frame < std::max<std::size_t>(frames_.size(), 1); ++frame) {
      const auto done = measure_frame_of(frame, progress, results);
      if (!is_done(done)) return done;
    }
    note_equal(results);
    return Outcome::kDone;
  }

  // The settings of one of the plan's frames.
  rtapi::Result<Outcome> measure_frame_of(std::size_t frame, const Progress& progress,
                                          std::vector<StudyResult>& results) {
    MeasurePlan plan = plan_;
    plan.settings.clear();
    std::vector<std::size_t> settings;  // their places in plan_
    for (std::size_t i = 0; i < plan_.settings.size(); ++i) {
      if (plan_.settings[i].frame != frame) continue;
      settings.push_back(i);
      plan.settings.push_back(plan_.settings[i]);
    }
    if (settings.empty()) return Outcome::kDone;
    Options options = options_;
    if (part_.family.is_sweep) {
      drop_unused_references(plan);
      if (!plan.against_truth) options.measure_truth = 0;
    }
    std::optional<Scene> changed;
    if (!frames_.empty()) {
      changed = scene_;
      frames_[frame].change(options, *changed);
    }
    MeasuredTable table;
    const LookAt look_at = [&](std::size_t setting, const FloatImage& image, const Target& target,
                               const Target* truth) {
      Checksum checksum;
      checksum.add_values(image.values);
      pictures_[settings[setting]] = checksum.value();
      const auto& [result, row] = places_[settings[setting]];
      return keep_pictures(row, image, truth != nullptr ? *truth : target, results[result]);
    };
    const Scene& scene = changed ? *changed : scene_;
    const auto done = part_.moves ? run_motion(plan, options, scene, progress, table, look_at)
                                  : run_plan(plan, options, scene, progress, table, look_at);
    if (!is_done(done)) return done;
    std::vector<double> fixed_ms(table.rows.size());
    if (!part_.moves && !part_.family.is_sweep) {
      const auto split = split_times(plan, options, scene, progress, table, fixed_ms);
      if (!is_done(split)) return split;
    }
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const MeasuredRow& measured = table.rows[i];
      StudyResult& result = results[places_[settings[i]].first];
      fill(measured, row_of(settings[i], results));
      row_of(settings[i], results).fixed_ms = fixed_ms[i];
      result.subtitle = table.subtitle;
      result.signal = plan_.signal;
      result.about = table.about;
      result.truth = measured.truth ? std::string("path-traced truth")
                                    : fmt::format("ray traced effect with {} samples a pixel",
                                                  options_.measure_reference);
      result.truth_error = measured.truth ? measured.truth_rmse : measured.reference_rmse;
    }
    return Outcome::kDone;
  }

  // A quarter of the pixels takes ms / 4 and 3/4 of what does not grow with them.
  static rtapi::Result<Outcome> split_times(const MeasurePlan& plan, const Options& options,
                                            const Scene& scene, const Progress& progress,
                                            const MeasuredTable& whole,
                                            std::vector<double>& fixed_ms) {
    MeasurePlan timed = plan;
    timed.against_truth = false;
    timed.also = {};
    Options own = options;
    own.frame.width = std::max(options.frame.width / 2, 1u);
    own.frame.height = std::max(options.frame.height / 2, 1u);
    own.measure_truth = 0;
    own.measure_reference = 1;
    const double pixels = static_cast<double>(options.frame.width) * options.frame.height;
    const double part = static_cast<double>(own.frame.width) * own.frame.height / pixels;
    if (part >= 1) return Outcome::kDone;
    MeasuredTable small;
    const auto done = run_plan(timed, own, scene, progress, small);
    if (!is_done(done)) return done;
    for (std::size_t i = 0; i < fixed_ms.size(); ++i) {
      const double ms = whole.rows[i].ms;
      fixed_ms[i] = std::clamp((small.rows[i].ms - part * ms) / (1 - part), 0.0, ms);
    }
    return Outcome::kDone;
  }

  static void drop_unused_references(MeasurePlan& plan) {
    std::erase_if(plan.references, [&](const MeasurePlan::Reference& reference) {
      return std::none_of(plan.settings.begin(), plan.settings.end(),
                          [&](const auto& each) { return each.reference == reference.name; });
    });
  }

  StudyRow begin_row(const MeasuredSetting& measured) const {
    StudyRow row;
    row.effect = measured.setting.effect;
    row.technique = measured.group;
    row.label = measured.label;
    row.command = fmt::format("{} --families {} --rows \"{}\"", options_.command, part_.family.name,
                              row_name(measured));
    return row;
  }

  std::string why_missing() const {
    if (part_.family.effect == "sun" && !scene_.sun) return "the scene has no sun";
    if (part_.family.effect == "contact" && scene_.lights.empty()) {
      return "the scene has no local light";
    }
    if (measures_panes(part_.family.effect) && !scene_.sun) return "the scene has no sun";
    if (measures_glass(part_.family.effect) && !has_glass(scene_)) return "the scene has no glass";
    if (part_.moves && options_.measure_truth == 0) {
      return "--measure-truth 0 leaves nothing to compare moving pictures with";
    }
    return {};
  }

  // Two rows with one picture measure nothing, unless one of their effects says why.
  void note_equal(std::vector<StudyResult>& results) const {
    if (part_.family.is_sweep) return;  // over a wide enough range a setting stops to matter
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      const auto first = std::find(pictures_.begin(), pictures_.end(), pictures_[i]);
      const auto same = static_cast<std::size_t>(first - pictures_.begin());
      if (same == i) continue;
      StudyRow& row = row_of(i, results);
      const StudyRow& other = row_of(same, results);
      std::string why;
      for (const std::string& effect : {row.effect, other.effect}) {
        const Effect* of = find_effect(northlight_effects(), effect);
        if (why.empty() && of != nullptr) why = of->may_equal;
      }
      row.note = fmt::format("the same picture as {}: {}", setting_name(other),
                             why.empty() ? kUnexplained : why);
    }
  }

  // Runs --measure svgf and takes the last frames at rest and along the path: a result for each
  // signal.
  rtapi::Result<Outcome> measure_filters(const Progress& progress,
                                         std::vector<StudyResult>& results) {
    Options own = options_;
    const bool is_sweep = part_.family.is_sweep;
    std::vector<std::string> effects = {"gi"};
    if (!is_sweep) effects.emplace_back("reflections");
    if (!is_sweep && scene_.sun) effects.insert(effects.begin(), "sun");
    choose(own, effects);
    if (own.camera_path.empty()) own.camera_path = "dolly";
    struct Seen {
      std::size_t row;
      FloatImage image;
      Target target;
    };
    std::vector<Seen> seen;
    MeasuredTable table;
    const auto done = measure_denoisers(
        own, scene_, progress, table,
        [&](std::size_t row, const FloatImage& image, const Target& target, const Target*) {
          seen.push_back({row, image, target});
          return rtapi::Status();
        },
        is_sweep ? lagging_denoisers() : measured_denoisers());
    if (!is_done(done)) return done;
    for (const Seen& each : seen) {
      const MeasuredRow& measured = table.rows[each.row];
      // "SIGNAL, still, frame 8": the first frames have no history yet.
      const std::string place = measured.group.substr(measured.reference.size());
      const bool moves = place.find("still") == std::string::npos;
      if (place.ends_with("frame 1") || (moves && options_.quick)) continue;
      const std::string name = part_.name() + "-" + measured.reference + (moves ? "-motion" : "");
      if (results.empty() || results.back().family != name) {
        results.push_back(begin_result(name, part_.family.title + " of " + measured.reference));
        StudyResult& result = results.back();
        if (moves) result.title += ", in motion";
        result.subtitle = table.subtitle;
        result.signal = measured.reference;
        result.truth = fmt::format("mean of {} samples a pixel", options_.measure_reference);
        result.truth_error = measured.reference_rmse;
        result.about = {
            "Milliseconds are those of the whole frame's rays and of the filters of "
            "all signals, in the eighth frame"};
      }
      StudyResult& result = results.back();
      StudyRow& row = result.rows.emplace_back();
      row.command = fmt::format("{} --families {}", options_.command, part_.family.name);
      fill(measured, row);
      std::tie(row.technique, row.label) = denoiser_names(measured.label);
      if (is_sweep) row.technique = measured.label.substr(0, measured.label.find(", "));
      const auto kept = keep_pictures(result.rows.size() - 1, each.image, each.target, result);
      if (!kept) return kept.error();
    }
    return Outcome::kDone;
  }

  rtapi::Result<Outcome> measure_ways(const Progress& progress, std::vector<StudyResult>& results) {
    StudyResult result = begin_result(part_.name(), part_.family.title);
    result.signal = "radiance";
    result.truth = "the same frame by many samples";
    MeasuredTable table;
    const LookAt look_at = [&](std::size_t way, const FloatImage& image, const Target& target,
                               const Target*) {
      const MeasuredRow& measured = table.rows[way];
      StudyRow& row = result.rows.emplace_back();
      row.technique = measured.group;
      row.label = measured.label;
      row.command = fmt::format("{} --families {}", options_.command, part_.family.name);
      fill(measured, row);
      return keep_pictures(result.rows.size() - 1, image, target, result);
    };
    const auto done =
        measure_frame_ways(part_.family.name, options_, scene_, progress, table, look_at);
    if (!is_done(done)) return done;
    result.subtitle = table.subtitle;
    result.about = table.about;
    results.push_back(std::move(result));
    return Outcome::kDone;
  }

  rtapi::Result<Outcome> measure_lag_of(LagCause cause, const Progress& progress,
                                        std::vector<StudyResult>& results) {
    StudyResult result = begin_result(part_.name(), part_.family.title);
    result.signal = "indirect light";
    result.truth = "mean of the raw frames behind the change";
    MeasuredTable table;
    const LookAt look_at = [&](std::size_t setting, const FloatImage& image, const Target& target,
                               const Target*) {
      const MeasuredRow& measured = table.rows[setting];
      StudyRow& row = result.rows.emplace_back();
      row.effect = "gi";
      row.technique = measured.group;
      row.label = measured.label;
      row.command = fmt::format("{} --families {}", options_.command, part_.family.name);
      fill(measured, row);
      return keep_pictures(result.rows.size() - 1, image, target, result);
    };
    const auto done = measure_lag(cause, options_, scene_, progress, table, look_at);
    if (!is_done(done)) return done;
    result.subtitle = table.subtitle;
    results.push_back(std::move(result));
    return Outcome::kDone;
  }

  static void fill(const MeasuredRow& measured, StudyRow& row) {
    const Errors::Summary& errors = measured.truth ? *measured.truth : measured.errors;
    row.ms = measured.ms;
    row.ms_spread = measured.ms > 0 ? (measured.ms_max - measured.ms_min) / measured.ms : 0;
    row.traced = measured.traced;
    row.error = errors.rmse;
    row.flip = errors.flip;
    row.ssim = errors.ssim;
    row.energy = errors.energy_ratio;
    row.flicker = measured.flicker;
    row.also = measured.also;
  }

  rtapi::Status keep_pictures(std::size_t setting, const FloatImage& image, const Target& wanted,
                              StudyResult& result) const {
    const FloatImage seen = as_seen(image, wanted.exposure);
    const FloatImage right = as_seen(wanted.image, wanted.exposure);
    StudyRow& row = result.rows[setting];
    row.picture = fmt::format("{}-{}.png", result.family, setting);
    row.difference = fmt::format("{}-{}-difference.png", result.family, setting);
    result.truth_picture = result.family + "-truth.png";
    const std::tuple<std::string, FloatImage> pictures[] = {
        {row.picture, seen},
        {row.difference, difference(seen, right)},
        {result.truth_picture, right}};
    for (const auto& [name, picture] : pictures) {
      const auto written = write_png(folder_ + "/" + name, as_bytes(picture, wanted.mask));
      if (!written.ok()) return written.error();
    }
    return {};
  }

  const StudyPart& part_;
  Options options_;
  const Scene& scene_;
  std::string folder_;
  MeasurePlan plan_;
  std::vector<StudyFrame> frames_;
  std::vector<std::pair<std::size_t, std::size_t>> places_;  // of settings: result, row
  std::vector<std::uint64_t> pictures_;                      // of settings, by their checksums
};

}  // namespace

std::string StudyPart::name(const std::string& question) const {
  return family.name + question + (moves ? "-motion" : "") + (is_smaller ? "-" + backend : "");
}

std::vector<StudyPart> study_parts(const StudyFamily& family, const Options& options) {
  std::vector<StudyPart> out;
  const bool both = options.backend == kBothBackends;
  for (const bool is_second : {false, true}) {
    if (is_second && !both) continue;
    const std::string backend = is_second ? "vulkan" : both ? "embree" : options.backend;
    for (const bool moves : {false, true}) {
      // Denoisers are measured at rest and in motion at once; --quick stays still, and what has no
      // path-traced truth has none in motion. Glass stands in front of a background at rest.
      const bool stays = family.effect.empty() || family.effect == "contact" ||
                         family.effect == "transparent" || family.is_sweep;
      if (moves && (options.quick || stays)) continue;
      out.push_back({family, backend, moves, is_second});
    }
  }
  return out;
}

rtapi::Result<Outcome> study_part(const StudyPart& part, const Options& options, const Scene& scene,
                                  const Progress& progress, std::vector<StudyResult>& results) {
  return PartStudy(part, options, scene).run(progress, results);
}

}  // namespace kaamos::measure
