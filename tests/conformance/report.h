// SPDX-License-Identifier: MIT
//
// Results as text and JSON.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/conformance/run.h"

namespace kaamos::conformance {

using TargetResults = std::pair<Target, std::vector<RuleResult>>;

// "pass SBT-02  The record hit is ...", with indented lines after it.
std::string line_of(const RuleResult& result);
// "vulkan: 41 of 262 tests, now FLG-02, FLG-03"
std::string line_of(const Target& target, const Progress& progress);
// "vulkan: P of N required rules pass; failing: ...; not yet tested: K".
std::string summary_of(const TargetResults& results);
std::string json_of(const std::vector<TargetResults>& results);

}  // namespace kaamos::conformance
