// SPDX-License-Identifier: MIT
#include "tests/conformance/report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

namespace kaamos::conformance {

namespace {

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kPassed:
      return "pass";
    case Outcome::kFailed:
      return "fail";
    case Outcome::kKnownDeviation:
      return "known deviation";
    case Outcome::kNotApplicable:
      return "not applicable";
    case Outcome::kNotOffered:
      return "not offered";
    case Outcome::kRefused:
      return "refused";
    case Outcome::kNotTested:
      break;
  }
  return "not yet tested";
}

}  // namespace

std::string line_of(const RuleResult& result) {
  std::string out = name_of(result.outcome);
  out.resize(16, ' ');
  out += result.rule->id;
  out.resize(25, ' ');
  out += result.rule->title;
  if (result.outcome == Outcome::kPassed && result.rule->partly != nullptr) {
    out += std::string(" (") + result.rule->partly + ")";
  }
  std::istringstream detail(result.detail);
  int lines = 0;
  for (std::string line; std::getline(detail, line);) {
    // Prints the reason and the first line of what was found; JSON has the rest.
    if (result.outcome == Outcome::kKnownDeviation && ++lines > 2) break;
    const bool reason =
        result.outcome == Outcome::kNotApplicable || result.outcome == Outcome::kNotOffered;
    out += reason ? ": " + line : "\n    " + line;
  }
  return out;
}

std::string line_of(const Target& target, const Progress& progress) {
  return target.name() + ": " + std::to_string(progress.done) + " of " +
         std::to_string(progress.total) + " tests, now " + progress.now;
}

std::string summary_of(const TargetResults& results) {
  size_t required = 0, passed = 0, not_tested = 0, refused = 0;
  std::string failing, not_offered;
  for (const RuleResult& result : results.second) {
    if (result.outcome == Outcome::kNotOffered) {
      not_offered += (not_offered.empty() ? "" : ", ") + std::string(result.rule->id);
      continue;
    }
    if (result.outcome == Outcome::kRefused) {
      ++refused;
      continue;
    }
    if (!result.rule->required() || result.outcome == Outcome::kNotApplicable) continue;
    ++required;
    if (result.outcome == Outcome::kPassed) ++passed;
    if (result.outcome == Outcome::kNotTested) ++not_tested;
    if (result.outcome == Outcome::kFailed || result.outcome == Outcome::kKnownDeviation) {
      failing += (failing.empty() ? "" : ", ") + std::string(result.rule->id);
      if (result.outcome == Outcome::kKnownDeviation) failing += " (known)";
    }
  }
  const std::string tier = rtapi::GetName(results.first.tier);
  const bool lower = results.first.tier != rtapi::kHighestRaytracingTier;
  std::string out = results.first.name() + (lower ? " of tier " + tier : "") + ": " +
                    std::to_string(passed) + " of " + std::to_string(required) +
                    " required rules pass";
  if (!failing.empty()) out += "; failing: " + failing;
  if (not_tested > 0) out += "; not yet tested: " + std::to_string(not_tested);
  if (refused > 0) {
    out +=
        "; refused, because a device of tier " + tier + " lacks them: " + std::to_string(refused);
  }
  if (!not_offered.empty()) out += "; not offered: " + not_offered;
  return out;
}

std::string json_of(const std::vector<TargetResults>& results) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const TargetResults& each : results) {
    nlohmann::ordered_json rules = nlohmann::ordered_json::array();
    for (const RuleResult& result : each.second) {
      rules.push_back({{"rule", result.rule->id},
                       {"tag", std::string(1, result.rule->tag)},
                       {"title", result.rule->title},
                       {"result", name_of(result.outcome)},
                       {"seconds", std::round(result.seconds * 1000) / 1000},
                       {"detail", result.detail}});
    }
    out.push_back({{"target", each.first.name()}, {"summary", summary_of(each)}, {"rules", rules}});
  }
  return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace kaamos::conformance
