// SPDX-License-Identifier: MIT
//
// Tests whose parameter is the name of a backend. On Vulkan they are skipped or fail without a
// device, and fail for messages of the validation layers, as with KAAMOS_NEED_VULKAN.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "tests/vulkan/support.h"

namespace kaamos::test {

class OnBackends : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() != "vulkan") return;
    const std::string why = why_no_vulkan();
    if (!why.empty() && vulkan_is_required()) FAIL() << why;
    if (!why.empty()) GTEST_SKIP() << why;
    guard_.emplace();
  }

 private:
  std::optional<ValidationGuard> guard_;
};

}  // namespace kaamos::test
