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

// Makes a table of the share that each pass has of the sum, which leaves structures out.
StudyTable control_table(const Options& options, const ClaimTable& claims) {
  StudyTable out{
      "control", "The survey's Table 1: where a frame of Control spends its rays' time", {}, {}};
  out.cells.columns = {"pass, % of the sum", "setting", "Control, frame 1", "Control, frame 2"};
  for (const std::string& backend : claims.backends) out.cells.columns.push_back(backend);
  out.cells.columns.push_back("beside theirs");
  double sums[2] = {};
  std::vector<double> own_sums(claims.backends.size());
  for (const ControlPass& pass : claims.control) {
    if (pass.is_build) continue;
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
      fmt::format("Scene {}. Control: 2560 x 1440 on an RTX 3090; without structures it takes "
                  "{:.1f} and {:.1f} ms there",
                  options.scene, sums[0], sums[1]),
      "The last row of the survey's table, \"total cost for reflections\", 8.9 and 7.1 ms, is the "
      "sum of all ray traced passes without structures; with them it is 9.5 and 8.1 ms. Structures "
      "here are those of a frame that moves on by 1/30 s",
      "Why shares differ: the cores that trace rays also shade hits and filter here, where a GPU "
      "has "
      "units of their own for rays and textures; and every signal is filtered by SVGF here, by "
      "filters made for each signal in Control"};
  return out;
}

}  // namespace

rtapi::Result<Outcome> kept_tables(const std::string& file, const std::string& key,
                                   const MakeTables& make, std::vector<StudyTable>& tables) {
  if (const auto kept = parse_tables(read_text(file), key)) {
    tables.insert(tables.end(), kept->begin(), kept->end());
    return Outcome::kDone;
  }
  std::vector<StudyTable> made;
  if (const auto s = make(made); !is_done(s)) return s;
  ordered_json out = {{"key", key}, {"tables", ordered_json::array()}};
  for (const StudyTable& table : made) {
    out["tables"].push_back(as_json(table));
    tables.push_back(table);
  }
  const std::string text = out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  if (const auto s = write_text(file, text); !s) return s.error();
  return Outcome::kDone;
}

std::string tables_key(const Options& options, const Scene& scene) {
  return fmt::format("{} {} {}", picture_key(options, scene), options.repeats, options.cpu_clock);
}

rtapi::Result<Outcome> study_claims(const Options& options, const Scene& scene,
                                    const Progress& progress, std::vector<StudyTable>& tables) {
  const auto make = [&](std::vector<StudyTable>& out) -> rtapi::Result<Outcome> {
    ClaimTable claims;
    if (const auto s = measure_claims(options, scene, progress, claims); !is_done(s)) return s;
    out = {control_table(options, claims), claims_table(options, claims)};
    return Outcome::kDone;
  };
  return kept_tables(options.out + "/study/claims.json", tables_key(options, scene), make, tables);
}

}  // namespace kaamos::measure
