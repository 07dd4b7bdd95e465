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
};
// Every rule whose number begins with `filter`, in order. `on_result` may be null.
std::vector<RuleResult> run_rules(const Target& target, const std::string& device_name,
                                  const std::string& filter,
                                  void (*on_result)(const RuleResult& result));

}  // namespace kaamos::conformance
