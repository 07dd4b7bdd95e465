// SPDX-License-Identifier: MIT
#include "effects/measure/study/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr std::size_t kMostLines = 10;

std::string cost(const StudyRow& row) {
  return fmt::format("{:.3g} ms, error {:.3g}", row.ms, row.error);
}

bool is_about_filters(const StudyResult& result) {
  return result.family.starts_with("denoise");
}

bool is_moving(const StudyResult& result) {
  return result.family.find("-motion") != std::string::npos;
}

// The least of a number over the rows that count; null: there is none.
template <class Number, class Counts>
const StudyRow* least(const std::vector<StudyRow>& rows, Number number, Counts counts) {
  const StudyRow* best = nullptr;
  for (const StudyRow& row : rows) {
    if (!counts(row) || !std::isfinite(number(row))) continue;
    if (best == nullptr || number(row) < number(*best)) best = &row;
  }
  return best;
}

std::string front_line(const StudyResult& result) {
  const auto trades = result.trades();
  const auto front = pareto_front(trades);
  if (front.empty()) return result.title + ": no setting gave finite numbers";
  const StudyRow& fastest = result.rows[front.front()];
  const StudyRow& best = result.rows[front.back()];
  return fmt::format("{}: {} of {} settings are worth their time, from {} ({}) to {} ({})",
                     result.title, front.size(), trades.size(), setting_name(fastest),
                     cost(fastest), setting_name(best), cost(best));
}

// The technique that the others stand in for is the first; how near the others come to the truth,
// and what it takes to get there by it.
std::string others_line(const StudyResult& result) {
  const std::string& first = result.rows.front().technique;
  const auto error = [](const StudyRow& row) { return row.error; };
  const StudyRow* other =
      least(result.rows, error, [&](const StudyRow& row) { return row.technique != first; });
  if (other == nullptr) return {};
  const StudyRow* same = least(
      result.rows, [](const StudyRow& row) { return row.ms; },
      [&](const StudyRow& row) { return row.technique == first && row.error <= other->error; });
  const std::string begin = fmt::format("{}: beside {}, {} comes nearest to the truth ({})",
                                        result.title, first, setting_name(*other), cost(*other));
  if (same == nullptr) {
    return begin + fmt::format("; no setting of {} measured here is as near", first);
  }
  return begin + fmt::format("; {} takes {:.2g} times as long for an error no larger ({})",
                             setting_name(*same), same->ms / other->ms, cost(*same));
}

// Says for each signal at rest what the best filter makes of one ray.
std::string filters_line(const std::vector<StudyResult>& results) {
  std::string out;
  for (const StudyResult& result : results) {
    if (!is_about_filters(result) || is_moving(result) || result.rows.empty()) continue;
    const StudyRow& raw = result.rows.front();
    const StudyRow* best = least(
        result.rows, [](const StudyRow& row) { return row.error; },
        [&](const StudyRow& row) { return &row != &raw; });
    if (best == nullptr) continue;
    out += fmt::format("{}{} by {} from {:.3g} to {:.3g}", out.empty() ? "" : "; ", result.signal,
                       setting_name(*best), raw.error, best->error);
  }
  return out.empty() ? out : "Denoising takes errors down: " + out;
}

// Says for each study in motion which settings change least and most from frame to frame.
std::string flicker_line(const std::vector<StudyResult>& results) {
  std::string out;
  for (const StudyResult& result : results) {
    if (!is_moving(result) || result.rows.empty() || is_about_filters(result)) continue;
    const StudyRow* best = least(
        result.rows, [](const StudyRow& row) { return row.flicker; },
        [](const StudyRow& row) { return row.flicker >= 0; });
    const StudyRow* worst = least(
        result.rows, [](const StudyRow& row) { return -row.flicker; },
        [](const StudyRow& row) { return row.flicker >= 0; });
    if (best == nullptr || best == worst) continue;
    out += fmt::format("{}{} from {:.2g} ({}) to {:.2g} ({})", out.empty() ? "" : "; ",
                       result.family.substr(0, result.family.find("-motion")), best->flicker,
                       setting_name(*best), worst->flicker, setting_name(*worst));
  }
  return out.empty() ? out : "Change from frame to frame beyond motion: " + out;
}

// Says which settings show the same picture as others without a reason: their rows mislead.
std::string unexplained_line(const std::vector<StudyResult>& results) {
  std::string out;
  for (const StudyResult& result : results) {
    for (const StudyRow& row : result.rows) {
      if (row.note.find(kUnexplained) == std::string::npos) continue;
      out += (out.empty() ? "" : "; ") + setting_name(row);
    }
  }
  return out.empty() ? out : "Settings without effect, for which no reason is known: " + out;
}

}  // namespace

std::string setting_name(const StudyRow& row) {
  return row.technique + ", " + row.label;
}

std::vector<std::string> study_findings(const std::vector<StudyResult>& results) {
  std::vector<std::string> out, later;
  const auto add = [](std::vector<std::string>& to, const std::string& line) {
    if (!line.empty()) to.push_back(line);
  };
  for (const StudyResult& result : results) {
    if (is_about_filters(result)) continue;
    // What moves and the second backend come behind, if there is room.
    const bool is_first = result.title.find(',') == std::string::npos;
    if (result.rows.empty()) continue;
    if (!result.is_measured()) {
      add(is_first ? out : later, result.title + ": not measured, " + result.rows.front().missing);
      continue;
    }
    add(is_first ? out : later, front_line(result));
    add(is_first ? out : later, others_line(result));
  }
  add(out, filters_line(results));
  add(out, unexplained_line(results));
  add(out, flicker_line(results));
  for (const std::string& line : later) out.push_back(line);
  if (out.size() > kMostLines) out.resize(kMostLines);
  return out;
}

}  // namespace kaamos::measure
