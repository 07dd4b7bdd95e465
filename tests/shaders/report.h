// SPDX-License-Identifier: MIT
//
// The results of tests as people and CI systems read them.
#pragma once

#include <string>
#include <vector>

#include "tests/shaders/session.h"

namespace kaamos::shader_tests {

enum class Format { kPlain, kTap };

// A line for each test, and what it said. `verbose`: printf of tests that pass, too.
std::string to_text(const std::vector<TestResult>& results, Format format, bool verbose);
// "12 tests: 10 passed, 1 failed, 1 skipped"
std::string summary(const std::vector<TestResult>& results);
// JUnit's XML, a suite for each executor.
std::string to_junit(const std::string& file, const std::vector<TestResult>& results);

}  // namespace kaamos::shader_tests
