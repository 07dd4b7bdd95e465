// SPDX-License-Identifier: MIT
#include "effects/measure/study/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/measure/study/findings.h"
#include "effects/measure/study/fronts.h"

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

// What a frame takes of a measured setting: the rays of contact shadows end where the light's map
// is fine enough, which measuring leaves out.
EffectSettings for_frame(const MeasuredSetting& measured, const Options& options) {
  EffectSettings out = options.effects.at(measured.setting.effect);
  out.samples = measured.setting.settings.samples;
  out.radius = measured.setting.settings.radius;
  if (measured.setting.effect == "contact" && !measured.setting.lit) return out;
  out.constants = measured.setting.settings.constants;
  out.constants_bytes = measured.setting.settings.constants_bytes;
  return out;
}

// Milliseconds for the pixels of the frame.
double scaled_ms(const StudyRow& row, const StudyResult& result, const Options& options) {
  const double pixels = static_cast<double>(options.frame.width) * options.frame.height;
  const double measured = static_cast<double>(result.width) * result.height;
  const double scale = measured > 0 ? pixels / measured : 1.0;
  return row.fixed_ms + (row.ms - row.fixed_ms) * scale;
}

bool has_numbers(const StudyRow& row) {
  return row.missing.empty() && std::isfinite(row.ms) && std::isfinite(row.error);
}

void add_effects(const StudyFamily& family, const Options& options, const StudyResult& result,
                 Front& front) {
  Options whole = options;
  whole.rows.clear();
  const MeasurePlan plan = study_plan(family, whole, false).plan;
  for (const StudyRow& row : result.rows) {
    const MeasuredSetting* setting = has_numbers(row) ? find_measured(plan, row) : nullptr;
    if (setting == nullptr) continue;
    QualityChoice choice{family, row.effect, for_frame(*setting, options)};
    choice.option = "--effects " + row.effect;
    choice.name = setting_name(row);
    choice.ms = scaled_ms(row, result, options);
    choice.error = row.error;
    front.all.push_back({std::move(choice), row.traced});
  }
}

// Whole frames take what they take more than the plain one, the first row.
void add_ways(const StudyFamily& family, const Options& options, const StudyResult& result,
              Front& front) {
  double plain_ms = 0;
  for (const StudyRow& row : result.rows) {
    const FrameWay* way = has_numbers(row) ? find_way(family.name, row) : nullptr;
    if (way == nullptr) continue;
    const double ms = scaled_ms(row, result, options);
    if (way->option.empty()) plain_ms = ms;
    if (way->in_sequences && !options.frame.moving) continue;
    QualityChoice choice{family};
    choice.change = way->change;
    choice.option = way->option;
    choice.name = setting_name(row);
    // What traces every pixel takes no less than the plain frame, whatever the clock says.
    choice.ms = way->traces_less ? ms - plain_ms : std::max(ms - plain_ms, 0.0);
    choice.error = row.error;
    front.all.push_back({std::move(choice), 0});
  }
}

// As --denoise takes it.
std::string denoise_word(const MeasuredDenoiser& denoiser) {
  if (denoiser.desc.method == DenoiseMethod::kNone) return "none";
  return denoiser.label.substr(0, denoiser.label.find(','));
}

bool is_denoising(const StudyResult& result, const StudyFamily& family) {
  return result.family.starts_with(family.name + "-") &&
         result.family.find("-motion") == std::string::npos;
}

// Over all signals: the root of the mean square of the errors.
void add_denoisers(const StudyFamily& family, const Options& options,
                   const std::vector<StudyResult>& results, Front& front) {
  struct Sum {
    StudyRow row;
    double ms = 0, squares = 0;
    int signals = 0;
  };
  std::vector<Sum> sums;
  int signals = 0;
  for (const StudyResult& result : results) {
    if (!is_denoising(result, family) || result.rows.empty()) continue;
    ++signals;
    const double raw_ms = scaled_ms(result.rows.front(), result, options);
    for (const StudyRow& row : result.rows) {
      if (!has_numbers(row)) continue;
      auto found = std::find_if(sums.begin(), sums.end(), [&](const Sum& sum) {
        return sum.row.technique == row.technique && sum.row.label == row.label;
      });
      if (found == sums.end()) found = sums.insert(sums.end(), {row});
      // Every signal's row has the time of all filters.
      found->ms = std::max(scaled_ms(row, result, options) - raw_ms, 0.0);
      found->squares += row.error * row.error;
      ++found->signals;
    }
  }
  for (const Sum& sum : sums) {
    const MeasuredDenoiser* denoiser = find_denoiser(sum.row);
    if (denoiser == nullptr || sum.signals != signals) continue;
    // A still has no frames before it.
    if (denoiser->desc.method == DenoiseMethod::kTemporal && !options.frame.moving) continue;
    QualityChoice choice{family};
    choice.change = [desc = denoiser->desc](Options& to) { to.frame.denoise = desc; };
    choice.option = "--denoise " + denoise_word(*denoiser);
    choice.name = setting_name(sum.row);
    choice.ms = sum.ms;
    choice.error = std::sqrt(sum.squares / signals);
    front.all.push_back({std::move(choice), 0});
  }
}

Front front_of(const StudyFamily& family, const Options& options,
               const std::vector<StudyResult>& results) {
  Front out;
  if (family.name == "denoise") {
    add_denoisers(family, options, results, out);
  } else if (const StudyResult* result = find_result(family, results)) {
    family.effect.empty() ? add_ways(family, options, *result, out)
                          : add_effects(family, options, *result, out);
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
  if (found.choice.effect.empty()) {
    return with_reason(found, fmt::format("the fastest of {} whose error is at most {:g} times the "
                                          "least ({:.3g})",
                                          of_settings(front), kLowFactor, least));
  }
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

}  // namespace

const std::vector<std::string>& quality_names() {
  static const std::vector<std::string> names = {"low", "medium", "high", "ultra"};
  return names;
}

const MeasuredSetting* find_measured(const MeasurePlan& plan, const StudyRow& row) {
  for (const MeasuredSetting& each : plan.settings) {
    if (each.setting.effect != row.effect || each.group != row.technique) continue;
    if (each.label == row.label && each.setting.times_ao == 0) return &each;
  }
  return nullptr;
}

const MeasuredDenoiser* find_denoiser(const StudyRow& row) {
  static const std::vector<MeasuredDenoiser> all = [] {
    std::vector<MeasuredDenoiser> out = measured_denoisers();
    out.insert(out.begin(), {"raw", default_denoise(DenoiseMethod::kNone)});
    return out;
  }();
  for (const MeasuredDenoiser& each : all) {
    const auto [technique, label] = denoiser_names(each.label);
    if (technique == row.technique && label == row.label) return &each;
  }
  return nullptr;
}

const FrameWay* find_way(const std::string& family, const StudyRow& row) {
  for (const FrameWay& each : frame_ways(family)) {
    if (each.technique == row.technique && each.label == row.label) return &each;
  }
  return nullptr;
}

std::vector<StudyFamily> quality_families(const Options& options, const Scene& scene) {
  std::vector<StudyFamily> out;
  for (const StudyFamily& family : study_families()) {
    if (family.name == "contact") continue;
    const bool is_rendered_here =
        family.effect.empty()
            ? options.frame.whole_frame
            : is_rendered(scene, options.frame, northlight_effects(), family.effect);
    if (is_rendered_here) out.push_back(family);
  }
  return out;
}

std::vector<QualityChoice> choose_quality(const QualityGoal& goal, const Options& options,
                                          const std::vector<StudyFamily>& families,
                                          const std::vector<StudyResult>& results) {
  std::vector<Front> fronts;
  for (const StudyFamily& family : families) {
    Front front = front_of(family, options, results);
    // A single way to make the frame is no choice.
    const bool has_choice = !family.effect.empty() || front.all.size() > 1;
    if (!front.best.empty() && has_choice) fronts.push_back(std::move(front));
  }
  if (goal.budget_ms) return by_budget(*goal.budget_ms, fronts);
  std::vector<QualityChoice> out;
  for (const Front& front : fronts) out.push_back(by_quality(goal.quality, front));
  return out;
}

void apply_quality(const std::vector<QualityChoice>& choices, Options& options) {
  FrameSettings& frame = options.frame;
  for (const QualityChoice& choice : choices) {
    if (choice.effect.empty()) continue;
    options.effects[choice.effect] = choice.settings;
    // The family's own effect stays among the chosen ones, and what takes its place leaves it out
    // and is named in its place.
    const bool named = std::exchange(frame.effects[choice.family.effect].named, false);
    frame.effects[choice.effect] = choice.settings;
    frame.effects[choice.effect].named = named;
  }
  add_included(frame.effects, northlight_effects());
  frame.whole_frame = need_whole_frame(frame.effects);
  for (const QualityChoice& choice : choices) {
    if (choice.change) choice.change(options);
  }
}

std::string quality_text(const QualityGoal& goal, const std::vector<QualityChoice>& choices) {
  std::string out =
      goal.budget_ms
          ? fmt::format("budget {:g} ms:\n", *goal.budget_ms)
          : fmt::format("quality {}:\n", quality_names()[static_cast<std::size_t>(goal.quality)]);
  double sum = 0;
  for (const QualityChoice& each : choices) {
    out += fmt::format("  {}: {}{}: {:.3g} ms, error {:.3g}: {}\n", each.family.name, each.name,
                       each.option.empty() ? "" : " (" + each.option + ")", each.ms, each.error,
                       each.why);
    sum += each.ms;
  }
  out += fmt::format("  together {:.3g} ms, beside surfaces, lights and composition\n", sum);
  return out;
}

}  // namespace kaamos::measure
