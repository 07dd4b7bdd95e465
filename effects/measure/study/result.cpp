// SPDX-License-Identifier: MIT
#include "effects/measure/study/result.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace kaamos::measure {

using namespace kaamos::effects;
using nlohmann::ordered_json;

std::vector<Trade> StudyResult::trades() const {
  std::vector<Trade> out;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const StudyRow& row : rows) {
    out.push_back(row.missing.empty() ? Trade{row.ms, row.error} : Trade{kNone, kNone});
  }
  return out;
}

bool StudyResult::is_measured() const {
  return std::any_of(rows.begin(), rows.end(),
                     [](const StudyRow& row) { return row.missing.empty(); });
}

namespace {

ordered_json as_json(const StudyResult& result) {
  ordered_json rows = ordered_json::array();
  for (const StudyRow& row : result.rows) {
    rows.push_back({{"effect", row.effect},
                    {"technique", row.technique},
                    {"setting", row.label},
                    {"command", row.command},
                    {"missing", row.missing},
                    {"note", row.note},
                    {"ms", row.ms},
                    {"fixed_ms", row.fixed_ms},
                    {"ms_spread", row.ms_spread},
                    {"rays", row.traced},
                    {"rmse", row.error},
                    {"flip", row.flip},
                    {"ssim", row.ssim},
                    {"energy", row.energy},
                    {"flicker", row.flicker},
                    {"also", row.also},
                    {"picture", row.picture},
                    {"difference", row.difference}});
  }
  return {{"family", result.family},
          {"title", result.title},
          {"key", result.key},
          {"scene", result.scene},
          {"backend", result.backend},
          {"width", result.width},
          {"height", result.height},
          {"subtitle", result.subtitle},
          {"signal", result.signal},
          {"truth", result.truth},
          {"truth_picture", result.truth_picture},
          {"truth_rmse", result.truth_error},
          {"about", result.about},
          {"rows", rows}};
}

// What is not finite, such as the energy of what should be black, has no number in JSON.
double number_in(const ordered_json& in, const char* name) {
  const ordered_json& value = in.at(name);
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

StudyResult as_result(const ordered_json& in) {
  StudyResult out;
  in.at("family").get_to(out.family);
  in.at("title").get_to(out.title);
  in.at("key").get_to(out.key);
  in.at("scene").get_to(out.scene);
  in.at("backend").get_to(out.backend);
  in.at("width").get_to(out.width);
  in.at("height").get_to(out.height);
  in.at("subtitle").get_to(out.subtitle);
  in.at("signal").get_to(out.signal);
  in.at("truth").get_to(out.truth);
  in.at("truth_picture").get_to(out.truth_picture);
  out.truth_error = number_in(in, "truth_rmse");
  in.at("about").get_to(out.about);
  for (const ordered_json& each : in.at("rows")) {
    StudyRow row;
    each.at("effect").get_to(row.effect);
    each.at("technique").get_to(row.technique);
    each.at("setting").get_to(row.label);
    each.at("command").get_to(row.command);
    each.at("missing").get_to(row.missing);
    each.at("note").get_to(row.note);
    row.ms = number_in(each, "ms");
    if (each.contains("fixed_ms")) row.fixed_ms = number_in(each, "fixed_ms");
    row.ms_spread = number_in(each, "ms_spread");
    row.traced = number_in(each, "rays");
    row.error = number_in(each, "rmse");
    row.flip = number_in(each, "flip");
    row.ssim = number_in(each, "ssim");
    row.energy = number_in(each, "energy");
    row.flicker = number_in(each, "flicker");
    each.at("also").get_to(row.also);
    each.at("picture").get_to(row.picture);
    each.at("difference").get_to(row.difference);
    out.rows.push_back(row);
  }
  return out;
}

}  // namespace

std::string to_json(const std::vector<StudyResult>& results) {
  ordered_json out = ordered_json::array();
  for (const StudyResult& result : results) out.push_back(as_json(result));
  return out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::optional<std::vector<StudyResult>> parse_results(const std::string& text) {
  const ordered_json in = ordered_json::parse(text, nullptr, false);
  if (in.is_discarded()) return std::nullopt;
  try {
    std::vector<StudyResult> out;
    for (const ordered_json& each : in) out.push_back(as_result(each));
    return out;
  } catch (const ordered_json::exception&) {  // another version's
    return std::nullopt;
  }
}

Table as_csv(const std::vector<StudyResult>& results) {
  constexpr std::size_t kNumbers = 9;
  Table out;
  out.columns = {"family", "technique", "setting",  "ms",        "rays", "rmse", "flip",   "ssim",
                 "energy", "flicker",   "on_front", "ms_spread", "also", "note", "command"};
  for (const StudyResult& result : results) {
    std::vector<bool> is_on_front(result.rows.size());
    for (const std::size_t i : pareto_front(result.trades())) is_on_front[i] = true;
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
      const StudyRow& row = result.rows[i];
      auto& cells = out.rows.emplace_back(std::vector{result.family, row.technique, row.label});
      if (row.missing.empty()) {
        for (const double number :
             {row.ms, row.traced, row.error, row.flip, row.ssim, row.energy}) {
          cells.push_back(csv_number(number));
        }
        cells.push_back(row.flicker < 0 ? "" : csv_number(row.flicker));
        cells.push_back(is_on_front[i] ? "1" : "0");
        cells.push_back(csv_number(row.ms_spread));
        std::string also;
        for (const auto& [name, number] : row.also) {
          also += (also.empty() ? "" : "; ") + name + " " + csv_number(number);
        }
        cells.push_back(also);
        cells.push_back(row.note);
      } else {
        cells.resize(kNumbers + 4);
        cells.push_back("not measured: " + row.missing);
      }
      cells.push_back(row.command);
    }
  }
  return out;
}

Plot as_plot(const StudyResult& result) {
  Plot plot{.title = result.title,
            .subtitle = result.subtitle,
            .x_label = "time (ms)",
            .y_label = "root mean square error of the " + result.signal};
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const StudyRow& row = result.rows[i];
    if (!row.missing.empty()) continue;
    if (plot.series.empty() || plot.series.back().name != row.technique) {
      plot.series.push_back({row.technique, {}, true});
    }
    plot.series.back().points.push_back({row.ms, row.error, row.label, std::to_string(i)});
  }
  if (result.truth_error > 0) plot.levels.push_back({"the truth's own error", result.truth_error});
  return plot;
}

}  // namespace kaamos::measure
