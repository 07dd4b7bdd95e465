// SPDX-License-Identifier: MIT
#include "options_quality.h"

#include <algorithm>
#include <charconv>

#include "effects/measure/run/failure.h"
#include "effects/measure/study/fronts.h"
#include "options_settings.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

// "33ms", "33", "0.5s". Nothing: it is no time.
std::optional<double> parse_ms(const std::string& text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  const std::string unit(read.ptr, end);
  if (read.ec != std::errc() || !(number > 0) || number > 1e9) return std::nullopt;
  if (unit == "s") return number * 1000;
  return unit == "ms" || unit.empty() ? std::optional(number) : std::nullopt;
}

}  // namespace

void add_quality(CLI::App& app, Options& options, QualityWords& words) {
  auto* quality = app.add_option("--quality", words.quality,
                                 "low, medium, high or ultra: chooses the technique of each effect "
                                 "by what was measured in this scene, and says why; without "
                                 "--effects, of all effects")
                      ->check(CLI::IsMember(quality_names()));
  app.add_option("--budget", words.budget,
                 "a time, as 33ms: the least error that the effects can have within it, chosen "
                 "likewise")
      ->excludes(quality);
  app.add_option("--fronts", options.fronts,
                 "the study.json or fronts.json of --study that they choose from; default: "
                 "OUT/study.json, or what comes with the source, or a quick study, which is kept "
                 "in OUT/study");
}

std::string apply_quality_words(const QualityWords& words, Options& options) {
  if (!words.quality.empty()) {
    const auto& names = quality_names();
    const auto found = std::find(names.begin(), names.end(), words.quality);
    options.goal = {static_cast<Quality>(found - names.begin()), std::nullopt};
  }
  if (!words.budget.empty()) {
    const std::optional<double> ms = parse_ms(words.budget);
    if (!ms) return "\"" + words.budget + "\" is no time: give milliseconds above 0, as in 33ms";
    options.goal = {Quality::kHigh, ms};
  }
  if (!options.fronts.empty() && !options.goal) return "--fronts requires --quality or --budget";
  return {};
}

rtapi::Result<Outcome> choose_techniques(Options& options, const Scene& scene,
                                         const Progress& progress, std::string& said) {
  const std::vector<StudyFamily> families = quality_families(options, scene);
  std::vector<StudyResult> results;
  const auto done = find_fronts(options, options.fronts, scene, families, progress, results, said);
  if (!is_done(done)) return done;
  const std::vector<QualityChoice> choices =
      choose_quality(*options.goal, options, families, results);
  said = quality_text(*options.goal, choices) + "  " + said;
  for (const StudyFamily& family : families) {
    const auto is_own = [&](const QualityChoice& choice) {
      return choice.family.name == family.name;
    };
    if (std::none_of(choices.begin(), choices.end(), is_own)) {
      said += "  " + family.name + ": nothing was measured that a frame can take; it stays\n";
    }
  }
  apply_quality(choices, options);
  const std::string error = apply_settings(options);  // what was given one by one stays
  if (!error.empty()) return failure(error);
  return Outcome::kDone;
}

}  // namespace northlight
