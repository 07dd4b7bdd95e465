// SPDX-License-Identifier: MIT
#include "effects/measure/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/measure/run/failure.h"
#include "effects/measure/study/family_study.h"
#include "effects/measure/study/figure_18.h"
#include "effects/measure/study/findings.h"
#include "effects/measure/study/fronts.h"
#include "effects/measure/study/report.h"
#include "effects/measure/study/sweep_plans.h"
#include "effects/measure/study/tables.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

bool is_named(const std::string& family, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), family) != names.end();
}

bool is_wanted(const std::string& family, const std::vector<std::string>& names) {
  return names.empty() || is_named(family, names);
}

rtapi::Status write_files(const Options& options, const std::vector<StudyResult>& results,
                          const std::vector<StudyTable>& tables) {
  const auto page = study_page(options, results, tables);
  if (!page) return page.error();
  for (const StudyResult& result : results) {
    if (!result.is_measured()) continue;
    const std::string plot = options.out + "/study-" + result.family + ".svg";
    if (const auto s = write_text(plot, plot_svg(as_plot(result))); !s) return s;
  }
  for (const StudyTable& table : tables) {
    const std::string file = options.out + "/study-" + table.name + ".csv";
    if (const auto s = write_text(file, write_csv(table.cells)); !s) return s;
  }
  for (const auto& [file, text] : {std::pair<std::string, std::string>("study.html", *page),
                                   {"study.csv", write_csv(as_csv(results))},
                                   {"study.json", to_json(results)},
                                   {"fronts.json", to_fronts(options, results)}}) {
    if (const auto s = write_text(options.out + "/" + file, text); !s) return s;
  }
  return {};
}

}  // namespace

rtapi::Result<Outcome> run_study(const Options& options, const Scene& scene,
                                 const Progress& progress, std::string& said) {
  for (const char* folder : {"/study", "/measure-cache"}) {
    std::error_code failed;
    std::filesystem::create_directories(options.out + folder, failed);
    if (!failed) continue;
    return failure(
        fmt::format("cannot make the folder {}{}: {}", options.out, folder, failed.message()));
  }
  std::vector<StudyResult> results;
  std::vector<StudyFamily> families = study_families();
  std::erase_if(families,
                [&](const auto& each) { return !is_wanted(each.name, options.families); });
  for (const StudyFamily& sweep : study_sweeps()) {
    if (is_named(sweep.name, options.families) || is_named("sweeps", options.families)) {
      families.push_back(sweep);
    }
  }
  for (const StudyFamily& family : families) {
    for (const StudyPart& part : study_parts(family, options)) {
      const auto step = [&](const std::string& what, double done) {
        return progress(part.name() + ": " + what, done);
      };
      const auto done = study_part(part, options, scene, step, results);
      if (!is_done(done)) return done;
    }
  }
  std::vector<StudyTable> tables = shadow_tables(results);
  if (is_wanted("figure-18", options.families)) {
    const auto step = [&](const std::string& what, double done) {
      return progress("figure 18: " + what, done);
    };
    if (const auto s = study_figure_18(options, scene, step, tables); !is_done(s)) return s;
  }
  if (is_wanted("claims", options.families)) {
    const auto step = [&](const std::string& what, double done) {
      return progress("claims: " + what, done);
    };
    if (const auto s = study_claims(options, scene, step, tables); !is_done(s)) return s;
  }
  if (const auto s = write_files(options, results, tables); !s) return s.error();
  for (const std::string& line : study_findings(results)) said += line + "\n";
  said += fmt::format(
      "\nwrote {}/study.html, .csv, .json, fronts.json and study-FAMILY.svg, study-TABLE.csv\n",
      options.out);
  return Outcome::kDone;
}

}  // namespace kaamos::measure
