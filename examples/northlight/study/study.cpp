// SPDX-License-Identifier: MIT
#include "study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "../failure.h"
#include "effects/common/file.h"
#include "effects/image/png.h"
#include "plans.h"
#include "report.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

constexpr float kShownDifference = 4;

rtapi::Status write_text(const std::string& path, const std::string& text) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  if (const auto s = write_file_atomically(path, {bytes, text.size()}); !s.ok()) return s.error();
  return {};
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// Of floats from 0 to 1; what the mask leaves out is grey.
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

class FamilyStudy {
 public:
  FamilyStudy(const StudyFamily& family, const Options& options, const Scene& scene)
      : family_(family),
        options_(options),
        scene_(scene),
        folder_(options.out + "/study"),
        plan_(study_plan(family, options, options.quick)) {}

  rtapi::Result<Outcome> run(const Progress& progress, StudyResult& result) {
    result.family = family_.name;
    result.title = family_.title;
    result.key = key();
    const std::string file = folder_ + "/" + family_.name + ".json";
    if (const auto kept = parse_result(read_text(file)); kept && kept->key == result.key) {
      result = *kept;
      return Outcome::kDone;
    }
    if (family_.effect == "sun" && !scene_.sun) {
      result.skipped = "the scene has no sun";
    } else if (const auto measured = measure(progress, result); !is_done(measured)) {
      return measured;
    }
    if (const auto s = write_text(file, to_json(result)); !s) return s.error();
    return Outcome::kDone;
  }

 private:
  std::string key() const {
    std::string text =
        fmt::format("{} {}x{} {} {} {} {} {}", volume_key(options_), options_.frame.width,
                    options_.frame.height, options_.backend, options_.repeats,
                    options_.measure_reference, options_.measure_truth, options_.cpu_clock);
    for (const MeasuredSetting& each : plan_.settings) text += "|" + each.group + "/" + each.label;
    return text;
  }

  rtapi::Result<Outcome> measure(const Progress& progress, StudyResult& result) {
    result.rows.assign(plan_.settings.size(), {});
    MeasuredTable table;
    const auto done = run_plan(
        plan_, options_, scene_, progress, table,
        [&](std::size_t setting, const FloatImage& image, const Target& target,
            const Target* truth) { return keep_pictures(setting, image, target, truth, result); });
    if (!is_done(done)) return done;
    result.subtitle = table.subtitle;
    result.signal = plan_.signal;
    result.about = table.about;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const MeasuredRow& measured = table.rows[i];
      const Errors::Summary& errors = measured.truth ? *measured.truth : measured.errors;
      StudyRow& row = result.rows[i];
      row.technique = measured.group;
      row.label = measured.label;
      row.ms = measured.ms;
      row.traced = measured.traced;
      row.error = errors.rmse;
      row.flip = errors.flip;
      row.ssim = errors.ssim;
      row.energy = errors.energy_ratio;
      result.truth = measured.truth ? fmt::format("path-traced truth of {} samples a pixel",
                                                  options_.measure_truth)
                                    : fmt::format("the ray traced effect with {} samples a pixel",
                                                  options_.measure_reference);
      result.truth_error = measured.truth ? measured.truth_rmse : measured.reference_rmse;
    }
    return Outcome::kDone;
  }

  rtapi::Status keep_pictures(std::size_t setting, const FloatImage& image, const Target& target,
                              const Target* truth, StudyResult& result) const {
    const Target& wanted = truth != nullptr ? *truth : target;
    const FloatImage seen = as_seen(image, wanted.exposure);
    const FloatImage right = as_seen(wanted.image, wanted.exposure);
    StudyRow& row = result.rows[setting];
    row.picture = fmt::format("{}-{}.png", family_.name, setting);
    row.difference = fmt::format("{}-{}-difference.png", family_.name, setting);
    result.truth_picture = family_.name + "-truth.png";
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

  const StudyFamily& family_;
  const Options& options_;
  const Scene& scene_;
  std::string folder_;
  MeasurePlan plan_;
};

bool is_wanted(const StudyFamily& family, const std::vector<std::string>& names) {
  return names.empty() || std::find(names.begin(), names.end(), family.name) != names.end();
}

}  // namespace

rtapi::Result<Outcome> run_study(const Options& options, const Scene& scene,
                                 const Progress& progress) {
  for (const char* folder : {"/study", "/measure-cache"}) {
    std::error_code failed;
    std::filesystem::create_directories(options.out + folder, failed);
    if (!failed) continue;
    return failure(
        fmt::format("cannot make the folder {}{}: {}", options.out, folder, failed.message()));
  }
  std::vector<StudyResult> results;
  for (const StudyFamily& family : study_families()) {
    if (!is_wanted(family, options.families)) continue;
    const auto step = [&](const std::string& what, double done) {
      return progress(family.name + ": " + what, done);
    };
    results.emplace_back();
    const auto done = FamilyStudy(family, options, scene).run(step, results.back());
    if (!is_done(done)) return done;
  }
  const auto page = study_page(options.scene, options.out + "/study", results);
  if (!page) return page.error();
  std::string all = "[";
  for (const StudyResult& result : results) {
    all += (all.size() > 1 ? ",\n" : "\n") + to_json(result);
    if (!result.skipped.empty()) continue;
    const std::string plot = options.out + "/study-" + result.family + ".svg";
    if (const auto s = write_text(plot, plot_svg(as_plot(result))); !s) return s.error();
  }
  for (const auto& [file, text] : {std::pair<std::string, std::string>("study.html", *page),
                                   {"study.csv", write_csv(as_csv(results))},
                                   {"study.json", all + "]\n"}}) {
    if (const auto s = write_text(options.out + "/" + file, text); !s) return s.error();
  }
  for (const std::string& line : study_findings(results)) std::printf("%s\n", line.c_str());
  std::printf("\nwrote %s/study.html, .csv, .json and study-FAMILY.svg\n", options.out.c_str());
  std::fflush(stdout);
  return Outcome::kDone;
}

}  // namespace northlight
