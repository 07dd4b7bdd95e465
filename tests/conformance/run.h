// SPDX-License-Identifier: MIT
//
// Running the rules' tests, and what came of each rule.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/conformance/context.h"
#include "tests/conformance/rules.h"

namespace kaamos::conformance {

std::vector<RuleTest> all_tests();
bool test_covers(const RuleTest& test, std::string_view rule);

// In this process. What was expected and found, one a line; empty: the rules hold.
std::string run_here(const RuleTest& test, const Target& target);
// In a process of its own, so that a driver that crashes or hangs fails one test. On Vulkan a
// crash is repeated once: drivers have faults that come and go.
std::string run_apart(const RuleTest& test, const Target& target);

// The device's name, or why there is none.
struct DeviceCheck {
  std::string name = {};
  std::string error = {};
};
DeviceCheck check_device(const Target& target);

enum class Outcome { kPassed, kFailed, kKnownDeviation, kNotApplicable, kNotTested };
struct RuleResult {
  const Rule* rule = nullptr;
  Outcome outcome = Outcome::kNotTested;
  std::string detail = {};
};
// Every rule whose number begins with `filter`, in order. `on_result` may be null.
std::vector<RuleResult> run_rules(const Target& target, const std::string& device_name,
                                  const std::string& filter,
                                  void (*on_result)(const RuleResult& result));

}  // namespace kaamos::conformance
