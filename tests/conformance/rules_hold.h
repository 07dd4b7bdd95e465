// SPDX-License-Identifier: MIT
//
// The tests of a section as a test of gtest.
#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <utility>

#include "tests/conformance/run.h"
#include "tests/vulkan/support.h"

namespace kaamos::conformance {

// The tests of a section run in one process, so that they share its device and pipelines.
class RulesHold : public testing::Test {
 public:
  RulesHold(Section section, Target target)
      : section_(std::move(section)), target_(std::move(target)) {}

  void TestBody() override {
    if (target_.backend == "vulkan") {
      KAAMOS_NEED_VULKAN();
      check_all();
    } else {
      check_all();
    }
  }

 private:
  void check_all() {
    rtapi::DeviceDesc desc;
    desc.Backend = target_.backend;
    const std::string device = rtapi::CreateDevice(desc).value().GetInfo().Name;
    for (const RuleTest& test : section_.tests) check(test, device);
  }
  void check(const RuleTest& test, const std::string& device) {
    const std::string failures = run_here(test, target_);
    if (failures.empty()) return;
    const std::string first = std::string(test.rules).substr(0, std::string(test.rules).find(','));
    if (const Deviation* known = find_deviation(first, target_.name(), device)) {
      std::cout << test.rules << ": known deviation: " << known->reason << "\n" << failures;
    } else {
      ADD_FAILURE() << test.rules << "\n" << failures;
    }
  }

  Section section_;
  Target target_;
};

}  // namespace kaamos::conformance
