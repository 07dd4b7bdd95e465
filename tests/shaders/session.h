// SPDX-License-Identifier: MIT
//
// Runs the tests of a file in a process of its own, which a fault or an endless loop may end: then
// the next one goes on behind the test that ended it.
#pragma once

#include <string>
#include <vector>

#include "tests/shaders/runner.h"

namespace kaamos::shader_tests {

struct TestResult {
  enum class Outcome { kPassed, kFailed, kSkipped };
  const TestRun* test = nullptr;
  std::string executor;
  Outcome outcome = Outcome::kPassed;
  std::vector<std::string> failures;
  std::vector<std::string> output;  // printf
  std::string skipped;              // why
  double seconds = 0;
};

struct SessionResult {
  std::vector<TestResult> results;
  std::string error;           // the file cannot be run at all
  bool has_no_device = false;  // is the error
};

// `runs`: those to run, of `source`. `timeout_seconds`: of one test.
SessionResult run_tests(const Source& source, const std::vector<const TestRun*>& runs,
                        const std::string& executor, double timeout_seconds);

}  // namespace kaamos::shader_tests
