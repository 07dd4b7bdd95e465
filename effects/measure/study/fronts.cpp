// SPDX-License-Identifier: MIT
#include "effects/measure/study/fronts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/measure/run/failure.h"
#include "effects/measure/run/machine.h"
#include "effects/measure/study/files.h"
#include "effects/measure/truth/committed_truth.h"

namespace kaamos::measure {

using namespace kaamos::effects;
using nlohmann::ordered_json;

namespace {

// Four digits are more than any of these numbers is good for.
double rounded(double value) {
  if (!(std::abs(value) > 0) || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, 3 - std::floor(std::log10(std::abs(value))));
  return std::round(value * unit) / unit;
}

ordered_json row_json(const StudyRow& row) {
  return {row.effect,         row.technique,      row.label, rounded(row.ms), rounded(row.fixed_ms),
          rounded(row.error), rounded(row.traced)};
}

StudyRow as_row(const ordered_json& in) {
  StudyRow out;
  in.at(0).get_to(out.effect);
  in.at(1).get_to(out.technique);
  in.at(2).get_to(out.label);
  in.at(3).get_to(out.ms);
  in.at(4).get_to(out.fixed_ms);
  in.at(5).get_to(out.error);
  in.at(6).get_to(out.traced);
  return out;
}

bool has_all(const std::vector<StudyFamily>& families, const std::vector<StudyResult>& results) {
  return std::all_of(families.begin(), families.end(), [&](const StudyFamily& family) {
    return find_result(family, results) != nullptr;
  });
}

// The file of the source tree; empty: it can have none of this scene.
std::string committed_fronts(const Options& options) {
  const bool is_changed = !options.materials.empty() || options.sun;
  if (options.fronts_folder.empty() || is_changed || options.backend != "embree") return {};
  return options.fronts_folder + "/" + options.scene + ".json";
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

std::string to_fronts(const Options& options, const std::vector<StudyResult>& results) {
  std::string out = fmt::format(
      "{{\n \"scene\": {},\n \"machine\": {},\n \"commit\": {},\n"
      " \"command\": {},\n \"row\": {},\n \"results\": [",
      ordered_json(options.scene).dump(), ordered_json(machine()).dump(),
      ordered_json(options.commit).dump(), ordered_json(options.command).dump(),
      ordered_json({"effect", "technique", "setting", "ms", "fixed ms", "rmse", "rays"}).dump());
  bool is_first = true;
  for (const StudyResult& result : results) {
    if (result.family.find("-motion") != std::string::npos || !result.is_measured()) continue;
    out += fmt::format(
        "{}\n  {{\"family\": {}, \"backend\": {}, \"width\": {}, \"height\": {}, "
        "\"rows\": [",
        is_first ? "" : ",", ordered_json(result.family).dump(),
        ordered_json(result.backend).dump(), result.width, result.height);
    is_first = false;
    std::string rows;
    for (const StudyRow& row : result.rows) {
      if (!row.missing.empty() || !std::isfinite(row.error)) continue;
      rows += (rows.empty() ? "\n   " : ",\n   ") + row_json(row).dump();
    }
    out += rows + "]}";
  }
  return out + "]\n}\n";
}

std::optional<std::vector<StudyResult>> parse_fronts(const std::string& text) {
  const ordered_json in = ordered_json::parse(text, nullptr, false);
  if (in.is_discarded()) return std::nullopt;
  try {
    std::vector<StudyResult> out;
    for (const ordered_json& each : in.at("results")) {
      StudyResult& result = out.emplace_back();
      in.at("scene").get_to(result.scene);
      each.at("family").get_to(result.family);
      each.at("backend").get_to(result.backend);
      each.at("width").get_to(result.width);
      each.at("height").get_to(result.height);
      for (const ordered_json& row : each.at("rows")) result.rows.push_back(as_row(row));
    }
    return out;
  } catch (const ordered_json::exception&) {  // another version's
    return std::nullopt;
  }
}

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

rtapi::Result<Outcome> find_fronts(const Options& options, const std::string& file,
                                   const Scene& scene, const std::vector<StudyFamily>& families,
                                   const Progress& progress, std::vector<StudyResult>& results,
                                   std::string& said) {
  if (!file.empty()) {
    const auto bytes = read_file(file);
    if (!bytes.ok()) return bytes.error();
    const std::string text(bytes.value().begin(), bytes.value().end());
    auto parsed = parse_results(text);
    if (!parsed) parsed = parse_fronts(text);
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
    if (has_all(families, *kept)) {
      results = std::move(*kept);
      said = "chosen from " + own + "\n";
      return Outcome::kDone;
    }
  }
  const std::string committed = committed_fronts(options);
  if (auto kept = parse_fronts(read_text(committed)); kept && has_all(families, *kept)) {
    results = std::move(*kept);
    said = "chosen from " + committed + "\n";
    return Outcome::kDone;
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
