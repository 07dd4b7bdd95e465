// SPDX-License-Identifier: MIT
//
// The Vulkan device of a test. Without one, the test is skipped with the backend's message that
// says what to install, or fails under KAAMOS_REQUIRE_VULKAN=1. Under KAAMOS_VULKAN_VALIDATION=1
// (which kaamos-isolate sets), the test fails for any message of the validation layers while it
// ran.
#pragma once

#include <gtest/gtest.h>
#include <rtapi/device.h>

#include <string>

namespace kaamos::test {

// Why no Vulkan device can be made; empty if one can.
std::string why_no_vulkan();
bool vulkan_is_required();

// Why the driver cannot be asked to compile this program's shaders; empty if it can. Without
// AVX-512, lavapipe reads memory by a branch for each lane, and LLVM 15 takes more than ten minutes
// and 5 GB for the pixel shader of 13-hybrid, almost all of it in the pass that moves code out of
// loops (runtime/vulkan/draws/README.md, LICM).
std::string why_driver_cannot_compile(const std::string& program);

// A device of that description for a test; the test fails without one. On Vulkan it is the same for
// all tests of the process that ask for nothing but an OnMessage, so that what one test has
// compiled serves the others (PipelineCache); the OnMessage that was given last is told. A device
// of other properties is the test's own, and so is each on Embree.
rtapi::Device device_for(const rtapi::DeviceDesc& desc);

// Collects the layers' messages during its lifetime and fails the test for each.
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

// The first line of a test on Vulkan.
#define KAAMOS_NEED_VULKAN()                                                   \
  if (const std::string why = ::kaamos::test::why_no_vulkan(); !why.empty()) { \
    if (::kaamos::test::vulkan_is_required()) FAIL() << why;                   \
    GTEST_SKIP() << why;                                                       \
  }                                                                            \
  const ::kaamos::test::ValidationGuard kaamos_validation_guard
