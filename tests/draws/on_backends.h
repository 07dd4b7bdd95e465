// SPDX-License-Identifier: MIT
//
// A test that runs on each backend, GetParam(). On Vulkan the validation layers watch it.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "tests/vulkan/support.h"

namespace kaamos::draws {

class OnBackends : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!on_vulkan()) return;
    if (const std::string why = test::why_no_vulkan(); !why.empty()) {
      if (test::vulkan_is_required()) FAIL() << why;
      GTEST_SKIP() << why;
    }
    validation_.emplace();
  }
  static bool can_run() { return !IsSkipped() && !HasFatalFailure(); }
  bool on_vulkan() const { return GetParam() == "vulkan"; }

 private:
  std::optional<test::ValidationGuard> validation_;
};

}  // namespace kaamos::draws
