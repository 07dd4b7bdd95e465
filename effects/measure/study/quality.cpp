// SPDX-License-Identifier: MIT
#include "effects/measure/study/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <tuple>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/measure/run/failure.h"
#include "effects/measure/study/family_study.h"
#include "effects/measure/study/files.h"
#include "effects/measure/study/findings.h"
#include "effects/measure/truth/committed_truth.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr double kLowFactor = 2;      // times the least error of what traces no rays
constexpr double kLeastRatio = 1e-3;  // of errors: a front may end at an error of 0

// A setting that a frame can take, with what was measured of it.
struct Candidate {
  QualityChoice choice;
  double traced = 0;  // rays a pixel
};

struct Front {
  std::vector<Candidate> all;
  std::vector<std::size_t> best;  // the Pareto front, by falling error
};

std::vector<Trade> trades(const std::vector<Candidate>& candidates) {
  std::vector<Trade> out;
  for (const Candidate& each : candidates) out.push_back({each.choice.ms, each.choice.error});
  return out;
}

// Null: no frame can take it.
const MeasuredSetting* find_measured(const MeasurePlan& plan, const StudyRow& row) {
  for (const MeasuredSetting& each : plan.settings) {
    if (each.setting.effect != row.effect || each.group != row.technique) continue;
    if (each.label == row.label && each.setting.times_ao == 0 && !each.setting.lit) return &each;
  }
  return nullptr;
}

// The question of a family at rest that most techniques answer; null: it was not measured.
const StudyResult* find_result(const StudyFamily& family, const std::vector<StudyResult>& results) {
  const StudyResult* out = nullptr;
  std::size_t most = 0;
  for (const StudyResult& result : results) {
    const bool is_own =
        result.family == family.name || result.family.starts_with(family.name + "-");
    if (!is_own || result.family.find("-motion") != std::string::npos) continue;
    std::set<std::string> techniques;
    for (const StudyRow& row : result.rows) {
      if (row.missing.empty()) techniques.insert(row.technique);
    }
    if (techniques.size() <= most) continue;
    most = techniques.size();
    out = &result;
  }
  return out;
}

// What a frame takes of a measured setting: the rays of contact shadows end where the light's map
// is fine enough, which measuring leaves out.
EffectSettings for_frame(const MeasuredSetting& measured, const Options& options) {
  EffectSettings out = options.effects.at(measured.setting.effect);
  out.samples = measured.setting.settings.samples;
  out.radius = measured.setting.settings.radius;
  if (measured.setting.effect == "contact") return out;
  out.constants = measured.setting.settings.constants;
  out.constants_bytes = measured.setting.settings.constants_bytes;
  return out;
}

Front front_of(const StudyFamily& family, const Options& options, const StudyResult& result) {
  Options whole = options;
  whole.rows.clear();
  const MeasurePlan plan = study_plan(family, whole, false).plan;
  const double pixels = static_cast<double>(options.frame.width) * options.frame.height;
  const double measured = static_cast<double>(result.width) * result.height;
  const double scale = measured > 0 ? pixels / measured : 1.0;
  Front out;
  for (const StudyRow& row : result.rows) {
    const MeasuredSetting* setting = row.missing.empty() ? find_measured(plan, row) : nullptr;
    if (setting == nullptr || !std::isfinite(row.ms) || !std::isfinite(row.error)) continue;
    out.all.push_back({{family,
                        row.effect,
                        for_frame(*setting, options),
                        setting_name(row),
                        row.ms * scale,
                        row.error,
                        {}},
                       row.traced});
  }
  out.best = pareto_front(trades(out.all));
  return out;
}

std::string of_settings(const Front& front) {
  return fmt::format("{} settings ({} on the Pareto front)", front.all.size(), front.best.size());
}

QualityChoice with_reason(const Candidate& candidate, std::string why) {
  QualityChoice out = candidate.choice;
  out.why = std::move(why);
  return out;
}

// Raster fallbacks. [survey 8]
QualityChoice lowest(const Front& front) {
  std::vector<Candidate> others;
  for (const Candidate& each : front.all) {
    if (each.traced == 0) others.push_back(each);
  }
  if (others.empty()) {
    return with_reason(front.all[front.best.front()],
                       "the fastest of " + of_settings(front) + "; all trace rays");
  }
  const std::vector<Trade> costs = trades(others);
  const double least = costs[pareto_front(costs).back()].error;
  const Candidate& found = others[cheapest_within(costs, kLowFactor * least)];
  const std::string why = fmt::format(
      "the fastest of {} without rays whose error is at most {:g} times the least of "
      "theirs ({:.3g})",
      others.size(), kLowFactor, least);
  for (const std::size_t place : front.best) {
    const Candidate& best = front.all[place];
    if (best.traced == 0 || best.choice.ms > found.choice.ms ||
        best.choice.error > found.choice.error) {
      continue;
    }
    return with_reason(best,
                       fmt::format("faster and nearer to the truth than {} ({:.3g} ms, error "
                                   "{:.3g}), {}",
                                   found.choice.name, found.choice.ms, found.choice.error, why));
  }
  return with_reason(found, why);
}

QualityChoice by_quality(Quality quality, const Front& front) {
  const QualityChoice low = lowest(front);
  if (quality == Quality::kLow) return low;
  const Candidate& best = front.all[front.best.back()];
  if (quality == Quality::kUltra) {
    return with_reason(best, "the least error of " + of_settings(front));
  }
  const double most = front.all[front.best.front()].choice.error;
  const double ratio = most > 0 ? std::max(best.choice.error / most, kLeastRatio) : 1.0;
  const double part = quality == Quality::kMedium ? 1.0 / 3.0 : 2.0 / 3.0;
  // Never worse than what is called low.
  const double wanted =
      std::max(std::min(most * std::pow(ratio, part), low.error), best.choice.error);
  const std::size_t found = cheapest_within(trades(front.all), wanted);
  return with_reason(
      front.all[found],
      fmt::format("the fastest of {} whose error is at most {:.3g}", of_settings(front), wanted));
}

// Fronts added up family by family; what another one beats in time and error falls out, so that few
// are left.
struct Sum {
  double ms = 0;
  double squares = 0;
  std::vector<std::size_t> places;  // in each front's `best`
};

std::vector<Sum> add_front(const std::vector<Sum>& sums, const Front& front) {
  std::vector<Sum> all;
  std::vector<Trade> costs;
  for (const Sum& sum : sums) {
    for (const std::size_t place : front.best) {
      const QualityChoice& choice = front.all[place].choice;
      Sum next = sum;
      next.ms += choice.ms;
      next.squares += choice.error * choice.error;
      next.places.push_back(place);
      costs.push_back({next.ms, next.squares});
      all.push_back(std::move(next));
    }
  }
  std::vector<Sum> out;
  for (const std::size_t i : pareto_front(costs)) out.push_back(all[i]);
  return out;
}

std::vector<QualityChoice> by_budget(double budget_ms, const std::vector<Front>& fronts) {
  std::vector<Sum> sums = {{}};
  for (const Front& front : fronts) sums = add_front(sums, front);
  // By rising time and falling error.
  const Sum* chosen = &sums.front();
  for (const Sum& sum : sums) {
    if (sum.ms <= budget_ms) chosen = &sum;
  }
  const bool fits = chosen->ms <= budget_ms;
  std::vector<QualityChoice> out;
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    const Candidate& candidate = fronts[i].all[chosen->places[i]];
    out.push_back(
        with_reason(candidate, (fits ? "part of the least error within the budget, of "
                                     : "the fastest, as nothing is within the budget, of ") +
                                   of_settings(fronts[i])));
  }
  return out;
}

// A quick study of its own: three settings of each technique, at rest.
Options quick_options(const Options& options) {
  Options out = options;
  std::tie(out.frame.width, out.frame.height) =
      committed_size(options).value_or(std::pair(160u, 90u));
  out.frame.moving = false;
  out.quick = true;
  out.families.clear();
  out.rows.clear();
  out.repeats = 2;
  out.measure_reference = 256;
  out.measure_truth = 256;
  return out;
}

rtapi::Status make_folders(const std::string& out) {
  for (const char* folder : {"/study", "/measure-cache"}) {
    std::error_code failed;
    std::filesystem::create_directories(out + folder, failed);
    if (!failed) continue;
    return failure(fmt::format("cannot make the folder {}{}: {}", out, folder, failed.message()));
  }
  return {};
}

}  // namespace

const std::vector<std::string>& quality_names() {
  static const std::vector<std::string> names = {"low", "medium", "high", "ultra"};
  return names;
}

std::vector<StudyFamily> quality_families(const Options& options, const Scene& scene) {
  std::vector<StudyFamily> out;
  for (const StudyFamily& family : study_families()) {
    if (!family.effect.empty() &&
        is_rendered(scene, options.frame, northlight_effects(), family.effect)) {
      out.push_back(family);
    }
  }
  return out;
}

std::vector<QualityChoice> choose_quality(const QualityGoal& goal, const Options& options,
                                          const std::vector<StudyFamily>& families,
                                          const std::vector<StudyResult>& results) {
  std::vector<Front> fronts;
  for (const StudyFamily& family : families) {
    const StudyResult* result = find_result(family, results);
    if (result == nullptr) continue;
    Front front = front_of(family, options, *result);
    if (!front.best.empty()) fronts.push_back(std::move(front));
  }
  if (goal.budget_ms) return by_budget(*goal.budget_ms, fronts);
  std::vector<QualityChoice> out;
  for (const Front& front : fronts) out.push_back(by_quality(goal.quality, front));
  return out;
}

void apply_quality(const std::vector<QualityChoice>& choices, Options& options) {
  FrameSettings& frame = options.frame;
  for (const QualityChoice& choice : choices) {
    options.effects[choice.effect] = choice.settings;
    // The family's own effect stays among the chosen ones, and what takes its place leaves it out
    // and is named in its place.
    const bool named = std::exchange(frame.effects[choice.family.effect].named, false);
    frame.effects[choice.effect] = choice.settings;
    frame.effects[choice.effect].named = named;
  }
  add_included(frame.effects, northlight_effects());
  frame.whole_frame = need_whole_frame(frame.effects);
}

std::string quality_text(const QualityGoal& goal, const std::vector<QualityChoice>& choices) {
  std::string out =
      goal.budget_ms
          ? fmt::format("budget {:g} ms:\n", *goal.budget_ms)
          : fmt::format("quality {}:\n", quality_names()[static_cast<std::size_t>(goal.quality)]);
  double sum = 0;
  for (const QualityChoice& each : choices) {
    out += fmt::format("  {}: {} (--effects {}): {:.3g} ms, error {:.3g}: {}\n", each.family.name,
                       each.name, each.effect, each.ms, each.error, each.why);
    sum += each.ms;
  }
  out += fmt::format("  together {:.3g} ms, beside surfaces, lights, denoising and composition\n",
                     sum);
  return out;
}

rtapi::Result<Outcome> find_fronts(const Options& options, const std::string& file,
                                   const Scene& scene, const std::vector<StudyFamily>& families,
                                   const Progress& progress, std::vector<StudyResult>& results,
                                   std::string& said) {
  if (!file.empty()) {
    const auto bytes = read_file(file);
    if (!bytes.ok()) return bytes.error();
    auto parsed = parse_results(std::string(bytes.value().begin(), bytes.value().end()));
    if (!parsed) return failure(file + " is no study.json of this version: run --study again");
    results = std::move(*parsed);
    said = "chosen from " + file + "\n";
    return Outcome::kDone;
  }
  const std::string own = options.out + "/study.json";
  if (auto kept = parse_results(read_text(own)); kept && !kept->empty()) {
    std::erase_if(*kept, [&](const StudyResult& result) {
      return result.scene != options.scene || result.backend != options.backend;
    });
    const auto is_there = [&](const StudyFamily& family) {
      return find_result(family, *kept) != nullptr;
    };
    if (std::all_of(families.begin(), families.end(), is_there)) {
      results = std::move(*kept);
      said = "chosen from " + own + "\n";
      return Outcome::kDone;
    }
  }
  if (const auto s = make_folders(options.out); !s) return s.error();
  const auto is_kept = [&](const StudyFamily& family) {
    return std::filesystem::exists(fmt::format("{}/study/{}.json", options.out, family.name));
  };
  if (!std::all_of(families.begin(), families.end(), is_kept)) {
    options.say(
        fmt::format("measuring the techniques in {}, which takes minutes; what was measured "
                    "is kept in {}/study",
                    options.scene, options.out));
  }
  const Options quick = quick_options(options);
  for (const StudyFamily& family : families) {
    const StudyPart part = {family, quick.backend};
    const auto step = [&](const std::string& what, double done) {
      return progress("measuring " + family.name + ": " + what, done);
    };
    const auto done = study_part(part, quick, scene, step, results);
    if (!is_done(done)) return done;
  }
  said = fmt::format("chosen from what was measured at {} x {} and is kept in {}/study\n",
                     quick.frame.width, quick.frame.height, options.out);
  return Outcome::kDone;
}

}  // namespace kaamos::measure
