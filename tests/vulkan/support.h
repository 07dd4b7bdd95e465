// SPDX-License-Identifier: MIT
//
// The Vulkan device of a test: where there is none, the test is skipped with the backend's sentence
// that says what to install, or fails under KAAMOS_REQUIRE_VULKAN=1. Under
// KAAMOS_VULKAN_VALIDATION=1 (which kaamos-isolate sets) the test fails for what the validation
// layers said while it ran.
#pragma once

#include <gtest/gtest.h>
#include <rtapi/device.h>

#include <string>

namespace kaamos::test {

// Empty where a Vulkan device can be made, else why not.
std::string why_no_vulkan();
bool vulkan_is_required();

// Collects the layers' messages until it is gone, and fails the test for each.
class ValidationGuard {
 public:
  ValidationGuard();
  ~ValidationGuard();
  ValidationGuard(const ValidationGuard&) = delete;
  ValidationGuard& operator=(const ValidationGuard&) = delete;

 private:
  std::shared_ptr<void> instance_;
  size_t position_ = 0;  // in its messages
};

}  // namespace kaamos::test

// First line of a test on Vulkan.
#define KAAMOS_NEED_VULKAN()                                                   \
  if (const std::string why = ::kaamos::test::why_no_vulkan(); !why.empty()) { \
    if (::kaamos::test::vulkan_is_required()) FAIL() << why;                   \
    GTEST_SKIP() << why;                                                       \
  }                                                                            \
  const ::kaamos::test::ValidationGuard kaamos_validation_guard
