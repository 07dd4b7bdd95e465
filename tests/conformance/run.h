// SPDX-License-Identifier: MIT
//
// Running the rules' tests, and what came of each rule.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/conformance/context.h"
#include "tests/conformance/rules.h"

namespace kaamos::conformance {

std::vector<Section> all_sections();
std::vector<RuleTest> all_tests();
bool test_covers(const RuleTest& test, std::string_view rule);

// Whether a message of checked mode is what the test's breaches must bring.
bool may_provoke(const RuleTest& test, std::string_view report);

// In this process. What was expected and found, one a line; empty: the rules hold.
std::string run_here(const RuleTest& test, const Target& target);
// In order, in another process, so that a driver that crashes or hangs fails one test: the next
// one gets a new process. On Vulkan a crash is repeated once: drivers have faults that come and go.
// `on_result` gets each test's index and what run_here() says, as they end.
void run_apart(const std::vector<RuleTest>& tests, const Target& target,
               const std::function<void(size_t index, const std::string& failures)>& on_result);

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
  double seconds = 0;  // of its tests, of which others may cover more rules
};
// Where a run stands: tests that ended, of how many, and the rules of the one that runs now.
struct Progress {
  size_t done = 0;
  size_t total = 0;
  const char* now = "";
};
// Every rule whose number begins with `filter`, in order. The callbacks may be null.
std::vector<RuleResult> run_rules(const Target& target, const std::string& device_name,
                                  const std::string& filter,
                                  const std::function<void(const RuleResult& result)>& on_result,
                                  const std::function<void(const Progress& progress)>& on_progress);

}  // namespace kaamos::conformance
