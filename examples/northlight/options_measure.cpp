// SPDX-License-Identifier: MIT
#include "options_measure.h"

#include <cstdio>
#include <tuple>

#include "effects/measure/curves/measure.h"
#include "effects/measure/study/plans.h"
#include "effects/measure/truth/committed_truth.h"
#include "watch.h"

namespace northlight {

using namespace kaamos::effects;

std::string join(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

void add_path_reference(CLI::App& app, Options& options) {
  auto* samples =
      app.add_option("--reference-path-traced", options.path_samples,
                     "render a path-traced reference of so many samples a pixel instead "
                     "of a frame: reference.exr and its layers")
          ->check(CLI::Range(2u, 1u << 24));
  app.add_option("--bounces", options.bounces,
                 "bounces of its paths after what the camera sees (unlimited)")
      ->needs(samples)
      ->check(CLI::Range(0u, 1u << 16));
  app.add_option("--time", options.seconds, "of it on the scene's clock, in seconds")
      ->needs(samples)
      ->check(CLI::Range(0.0, 1e6));
  app.add_flag("--reference-glass-shadows", options.glass_shadows,
               "glass tints the light that passes it, as glass-shadow does, in all of its layers")
      ->needs(samples);
  app.add_flag("--reference-lamps", options.each_lamp, "a layer for each local light, up to 16")
      ->needs(samples);
  app.add_flag("--half", options.half, "its file has half floats")->needs(samples);
  app.add_option("--save-seconds", options.save_seconds, "seconds between saves of what is done")
      ->needs(samples)
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e6));
  app.add_flag("--resume", options.resume, "go on with the reference in the folder of results")
      ->needs(samples);
}

void add_measuring(CLI::App& app, Options& options, MeasureWords& words) {
  app.add_option("--measure", options.measure,
                 "time against error over an effect's quality settings, as a table, a CSV file and "
                 "a plot; what is an alternative to rays is held against them: " +
                     join(measured_effects()))
      ->check(CLI::IsMember(measured_effects()));
  app.add_flag(
      "--claims", options.claims,
      "what the talk, the deck and the survey say about costs, beside measurements on each "
      "backend, as a table and a CSV file");
  auto* study = app.add_option(
      "--study", words.study,
      "every technique of each family over the scene of this name or file: time against error, as "
      "a report (study.html), CSV, JSON and plots; goes on where an earlier one was stopped");
  study->excludes("--scene");
  app.add_option("--families", options.families, "of --study: " + join(study_family_names()))
      ->delimiter(',')
      ->needs(study)
      ->check(CLI::IsMember(study_family_names()));
  app.add_option("--rows", options.rows,
                 "of --study: only these settings, EFFECT/SETTING as its reports name them in the "
                 "command of each row; may be repeated")
      ->needs(study)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag(
      "--quick", options.quick,
      "of --study: three settings of each technique, at rest, on one backend; of --measure: "
      "three settings of each group");
  app.add_option("--measure-reference", options.measure_reference,
                 "samples per pixel of --measure's references, which are kept in OUT/measure-cache")
      ->capture_default_str()
      ->check(CLI::Range(4u, 1u << 24));
  app.add_option("--measure-truth", options.measure_truth,
                 "samples per pixel of the path-traced truth that --measure holds effects against; "
                 "0: none")
      ->capture_default_str()
      ->check(CLI::Range(0u, 1u << 24));
  app.add_option("--repeats", options.repeats,
                 "runs of each setting that --measure and --claims time")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u));
  app.add_option(
         "--clock", words.clock,
         "clock of --measure and --claims: wall, or cpu (CPU time over threads, for a machine "
         "that does other work too)")
      ->capture_default_str()
      ->check(CLI::IsMember({"wall", "cpu"}));
  app.add_option("--seeds", options.seeds, "independent runs that --measure svgf takes")
      ->capture_default_str()
      ->check(CLI::Range(2u, 4096u));
}

// The words of a command line as a shell takes them, without the options that choose parts.
std::string typed_command(int argc, char** argv) {
  std::string out = "northlight";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::string option = word.substr(0, word.find('='));
    if (option == "--families" || option == "--rows" || option == "--out") {
      if (option == word) ++i;  // its value is the next word
      continue;
    }
    const bool is_plain = word.find_first_of(" \t\"'\\$`!&|;<>()*?[]#~") == std::string::npos;
    out += is_plain && !word.empty() ? " " + word : " '" + word + "'";
  }
  return out;
}

// "0e376842", with "-dirty" where files are changed; empty: there is no source tree.
std::string source_commit() {
  const auto folder = find_effects_folder();
  if (folder.empty()) return {};
  const std::string command = "git -C '" + folder.string() +
                              "' describe --always --dirty --exclude '*' --abbrev=12 2>/dev/null";
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  char text[64];
  while (std::fgets(text, sizeof text, pipe) != nullptr) out += text;
  if (pclose(pipe) != 0) return {};
  return out.substr(0, out.find('\n'));
}

void apply_measuring(const CLI::App& app, const MeasureWords& words, const SettingWords& settings,
                     Options& options) {
  FrameSettings& frame = options.frame;
  if (!options.measure.empty()) {
    if (app.count("--size") == 0) {
      std::tie(frame.width, frame.height) = default_measure_size(options.measure);
    }
    if (options.measure == "svgf" && app.count("--effects") == 0) choose(options, {"all"});
    options.glass_shadows = options.glass_shadows || measures_panes(options.measure);
    if (measures_glass(options.measure) && app.count("--scene") == 0) {
      options.scene = "glass-stack";
    }
  }
  if (const auto folder = find_effects_folder(); !folder.empty()) {
    options.committed = (folder.parent_path() / "tests/numerics/path_traced").string();
    options.fronts_folder = (folder / "measure/study/fronts").string();
  }
  if (!words.study.empty()) {
    options.scene = words.study;
    options.commit = source_commit();
    if (app.count("--size") == 0) {
      const auto committed = committed_size(options);
      std::tie(frame.width, frame.height) = committed.value_or(std::pair(160u, 90u));
    }
    if (app.count("--repeats") == 0) options.repeats = options.quick ? 2 : 5;
    if (app.count("--measure-reference") == 0) options.measure_reference = 256;
    if (app.count("--measure-truth") == 0) options.measure_truth = 256;
    if (app.count("--seeds") == 0) options.seeds = options.quick ? 2 : 4;
  }
  if (options.claims) {
    if (app.count("--size") == 0) std::tie(frame.width, frame.height) = std::pair(320u, 180u);
    // The time does not depend on what the cells hold.
    if (!is_chosen(settings, "volume-samples")) frame.volume.samples = 16;
  }
}

}  // namespace northlight
