// SPDX-License-Identifier: MIT
#include "effects/measure/study/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/measure/run/picture_key.h"
#include "effects/measure/study/files.h"
#include "effects/shadows/adaptive_shadow/adaptive_shadow.h"

namespace kaamos::measure {

using namespace kaamos::effects;
using nlohmann::ordered_json;

namespace {

ordered_json as_json(const StudyTable& table) {
  return {{"name", table.name},
          {"title", table.title},
          {"columns", table.cells.columns},
          {"rows", table.cells.rows},
          {"about", table.about}};
}

// Nothing where the text holds no tables of this key.
std::optional<std::vector<StudyTable>> parse_tables(const std::string& text,
                                                    const std::string& key) {
  const ordered_json in = ordered_json::parse(text, nullptr, false);
  if (in.is_discarded()) return std::nullopt;
  try {
    if (in.at("key") != key) return std::nullopt;
    std::vector<StudyTable> out;
    for (const ordered_json& each : in.at("tables")) {
      StudyTable& table = out.emplace_back();
      each.at("name").get_to(table.name);
      each.at("title").get_to(table.title);
      each.at("columns").get_to(table.cells.columns);
      each.at("rows").get_to(table.cells.rows);
      each.at("about").get_to(table.about);
    }
    return out;
  } catch (const ordered_json::exception&) {  // another version's
    return std::nullopt;
  }
}

StudyTable claims_table(const Options& options, const ClaimTable& claims) {
  StudyTable out{"claims", "What the talk, the deck and the survey say about costs", {}, {}};
  out.cells.columns = {"claim", "theirs"};
  for (const std::string& backend : claims.backends) out.cells.columns.push_back(backend);
  for (const Claim& claim : claims.claims) {
    auto& row = out.cells.rows.emplace_back(std::vector{claim.text, claim.seed});
    for (const auto& value : claim.here) row.push_back(value ? fmt::format("{:.3g}", *value) : "-");
  }
  out.about = {
      fmt::format("Scene {}, medians of {} rounds, one ray a pixel where nothing else is "
                  "said; the same as northlight --claims",
                  options.scene, options.repeats)};
  return out;
}

// Makes a table of the share that each of the eight passes has of their sum.
StudyTable control_table(const Options& options, const ClaimTable& claims) {
  StudyTable out{
      "control", "The survey's Table 1: where a frame of Control spends its rays' time", {}, {}};
  out.cells.columns = {"pass, % of the sum", "setting", "Control, frame 1", "Control, frame 2"};
  for (const std::string& backend : claims.backends) out.cells.columns.push_back(backend);
  out.cells.columns.push_back("beside theirs");
  double sums[2] = {};
  std::vector<double> own_sums(claims.backends.size());
  for (const ControlPass& pass : claims.control) {
    for (int frame = 0; frame < 2; ++frame) sums[frame] += pass.frames[frame];
    for (std::size_t i = 0; i < own_sums.size(); ++i) own_sums[i] += pass.here[i].value_or(0);
  }
  for (const ControlPass& pass : claims.control) {
    const double shares[2] = {100 * pass.frames[0] / sums[0], 100 * pass.frames[1] / sums[1]};
    const auto [low, high] = std::minmax(shares[0], shares[1]);
    auto& row = out.cells.rows.emplace_back(std::vector{pass.name, std::string("1 ray"),
                                                        fmt::format("{:.0f}", shares[0]),
                                                        fmt::format("{:.0f}", shares[1])});
    std::string beside;
    for (std::size_t i = 0; i < own_sums.size(); ++i) {
      if (!pass.here[i] || own_sums[i] <= 0) {
        row.push_back("-");
        continue;
      }
      const double share = 100 * *pass.here[i] / own_sums[i];
      row.push_back(fmt::format("{:.0f}", share));
      beside += fmt::format("{}x {:.2g} of their mean{}", beside.empty() ? "" : "; ",
                            share / (0.5 * (low + high)),
                            share >= low && share <= high ? ", between their frames" : "");
    }
    row.push_back(beside);
  }
  out.about = {
      fmt::format("Scene {}. Control: 2560 x 1440 on an RTX 3090; these eight passes take {:.1f} "
                  "and {:.1f} ms there",
                  options.scene, sums[0], sums[1]),
      "Theirs has transparent reflections too (1.5 and 0.4 ms) and 0.6 and 1.0 ms for building "
      "acceleration structures, which are not timed here. The last row of the survey's table, "
      "\"total "
      "cost for reflections\", 8.9 and 7.1 ms, is the sum of all ray traced passes without those "
      "builds; with them it is 9.5 and 8.1 ms",
      "Why shares differ: the cores that trace rays also shade hits and filter here, where a GPU "
      "has "
      "units of their own for rays and textures; and every signal is filtered by SVGF here, by "
      "filters made for each signal in Control"};
  return out;
}

// The columns are milliseconds for one light and for four. [survey: figure 18]
struct SurveyRow {
  const char* name;
  double pub[2], resort[2], breakfast[2];
};

constexpr SurveyRow kSurvey[] = {{"shadow map, hard", {0.7, 2.6}, {2.3, 9.1}, {0.9, 5.9}},
                                 {"rays, hard", {1.4, 4.8}, {1.3, 3.4}, {1.6, 3.7}},
                                 {"rays, soft, standard", {3.2, 13.5}, {2.7, 8.3}, {4.7, 11.0}},
                                 {"rays, soft, high", {3.5, 19.9}, {2.9, 12.0}, {6.5, 16.2}}};
constexpr std::size_t kRaysHard = 1;  // all else is told in its times

const StudyRow* find_row(const StudyResult& result, const std::string& effect,
                         const std::string& label) {
  const Effect* row = find_effect(northlight_effects(), effect);
  for (const StudyRow& each : result.rows) {
    if (row != nullptr && each.technique == row->about && each.label == label) return &each;
  }
  return nullptr;
}

std::string adaptive_label(std::uint32_t rays) {
  return fmt::format("{} rays at most", rays);
}

std::optional<StudyTable> figure_18(const StudyResult& result) {
  const StudyRow* ours[] = {
      find_row(result, "sun-map", "2048 x 2048"), find_row(result, "sun", "1 ray"),
      find_row(result, "adaptive-sun", adaptive_label(kAdaptiveStandardSamples)),
      find_row(result, "adaptive-sun", adaptive_label(kAdaptiveHighSamples))};
  for (const StudyRow* row : ours) {
    if (row == nullptr) return std::nullopt;
  }
  StudyTable out{"figure-18", "The survey's figure 18: shadow maps against rays", {}, {}};
  out.title += result.title.find(',') == std::string::npos
                   ? ""
                   : result.title.substr(result.title.find(','));
  if (result.family != "shadows") out.name += result.family.substr(std::string("shadows").size());
  out.cells.columns = {"time over that of hard rays",
                       "setting here",
                       "Pub, 1 light",
                       "4 lights",
                       "Resort, 1 light",
                       "4 lights",
                       "Breakfast, 1 light",
                       "4 lights",
                       "here, the sun",
                       "beside theirs of 1 light"};
  const SurveyRow& unit = kSurvey[kRaysHard];
  for (std::size_t i = 0; i < std::size(kSurvey); ++i) {
    const SurveyRow& row = kSurvey[i];
    auto& cells = out.cells.rows.emplace_back(std::vector{std::string(row.name), ours[i]->label});
    std::vector<double> theirs;
    for (const auto& [scene, by] : {std::pair(row.pub, unit.pub),
                                    {row.resort, unit.resort},
                                    {row.breakfast, unit.breakfast}}) {
      for (int lights = 0; lights < 2; ++lights) {
        cells.push_back(fmt::format("{:.2f}", scene[lights] / by[lights]));
      }
      theirs.push_back(scene[0] / by[0]);
    }
    const auto [low, high] = std::minmax_element(theirs.begin(), theirs.end());
    if (!ours[i]->missing.empty() || !(ours[kRaysHard]->ms > 0)) {
      cells.push_back("-");
      cells.push_back("not measured: " + ours[i]->missing);
      continue;
    }
    const double here = ours[i]->ms / ours[kRaysHard]->ms;
    cells.push_back(fmt::format("{:.2f}", here));
    cells.push_back(i == kRaysHard ? "the unit"
                    : here < *low  ? fmt::format("cheaper: {:.2g} of their least", here / *low)
                    : here > *high ? fmt::format("dearer: {:.2g} times their most", here / *high)
                                   : "agrees: between their scenes");
  }
  out.about = {
      result.is_measured()
          ? result.subtitle + fmt::format("; hard rays, which end at the first hit that they find, "
                                          "take {:.3g} ms",
                                          ours[kRaysHard]->ms)
          : result.title + ": not measured, " + ours[kRaysHard]->missing,
      "Theirs: 1920 x 1080, RTX 2080 Ti, maps of 2048 x 2048 texels; Pub 281 000, Resort 376 000, "
      "Breakfast 1.4 million triangles. Here: one scene and one light, the sun; four lights are "
      "not measured, since maps of the sun and adaptive rays are for the sun alone",
      "Why they differ: here maps are drawn by the same cores that trace rays, and a map costs as "
      "much for a small picture as for a large one; adaptive rays pay for passes over the picture "
      "that a GPU hides"};
  return out;
}

}  // namespace

rtapi::Result<Outcome> study_claims(const Options& options, const Scene& scene,
                                    const Progress& progress, std::vector<StudyTable>& tables) {
  const std::string file = options.out + "/study/claims.json";
  const std::string key =
      fmt::format("{} {} {}", picture_key(options, scene), options.repeats, options.cpu_clock);
  if (const auto kept = parse_tables(read_text(file), key)) {
    tables.insert(tables.end(), kept->begin(), kept->end());
    return Outcome::kDone;
  }
  ClaimTable claims;
  if (const auto s = measure_claims(options, scene, progress, claims); !is_done(s)) return s;
  ordered_json out = {{"key", key}, {"tables", ordered_json::array()}};
  for (const StudyTable& table : {control_table(options, claims), claims_table(options, claims)}) {
    out["tables"].push_back(as_json(table));
    tables.push_back(table);
  }
  const std::string text = out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  if (const auto s = write_text(file, text); !s) return s.error();
  return Outcome::kDone;
}

std::vector<StudyTable> shadow_tables(const std::vector<StudyResult>& results) {
  std::vector<StudyTable> out;
  for (const StudyResult& result : results) {
    if (!result.family.starts_with("shadows")) continue;
    if (auto table = figure_18(result)) out.push_back(*table);
  }
  return out;
}

}  // namespace kaamos::measure
