// SPDX-License-Identifier: MIT
//
// Runs the rules' tests and collects what came of each rule.
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

// Tells whether this message of checked mode is one that the test's violations must cause.
bool may_provoke(const RuleTest& test, std::string_view report);

// The device refused what a test does because its tier is too low for it, as it should.
bool refused_by_tier(const std::string& failures, rtapi::RaytracingTier tier);

// Runs in this process. Returns what was expected and found, one a line; empty: the rules hold.
std::string run_here(const RuleTest& test, const Target& target);
// Runs the tests in order in another process, so that a driver that crashes or hangs fails only one
// test: the next test gets a new process. A crash on Vulkan is repeated once, since some driver
// faults come and go. `on_result` gets each test's index and what run_here() returned, as tests
// end.
void run_apart(const std::vector<RuleTest>& tests, const Target& target,
               const std::function<void(size_t index, const std::string& failures)>& on_result);

// The device's name, or why there is no device.
struct DeviceCheck {
  std::string name = {};
  std::string error = {};
};
DeviceCheck check_device(const Target& target);

enum class Outcome {
  kPassed,
  kFailed,
  kKnownDeviation,
  kNotApplicable,
  kNotOffered,
  kRefused,  // by a device whose tier is below that of the rule
  kNotTested
};
struct RuleResult {
  const Rule* rule = nullptr;
  Outcome outcome = Outcome::kNotTested;
  std::string detail = {};
  double seconds = 0;  // of its tests, which may cover other rules too
};
// The progress of a run: tests done, tests in all, and the rules of the current test.
struct Progress {
  size_t done = 0;
  size_t total = 0;
  const char* now = "";
};
// Every rule that `filter` chooses (rules.h), in order. The callbacks may be null.
std::vector<RuleResult> run_rules(const Target& target, const std::string& device_name,
                                  const std::string& filter,
                                  const std::function<void(const RuleResult& result)>& on_result,
                                  const std::function<void(const Progress& progress)>& on_progress);

}  // namespace kaamos::conformance
