// SPDX-License-Identifier: MIT
//
// The device for a test. If there is none, the test is skipped with a sentence that says what to
// install, or fails if KAAMOS_REQUIRE_VULKAN is 1.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan::testing {

inline bool vulkan_is_required() {
  const char* value = std::getenv("KAAMOS_REQUIRE_VULKAN");
  return value != nullptr && std::strcmp(value, "1") == 0;
}

// With KAAMOS_VULKAN_VALIDATION=1, a test fails for anything that the layers reported until its
// devices were gone.
class ValidationGuard {
 public:
  ValidationGuard() {
    if (auto instance = Instance::get()) instance_ = *instance;
    if (instance_ != nullptr) instance_->validation_messages(&position_);
  }
  ~ValidationGuard() {
    if (instance_ == nullptr) return;
    for (const std::string& message : instance_->validation_messages(&position_)) {
      ADD_FAILURE() << message;
    }
  }

 private:
  std::shared_ptr<Instance> instance_;
  size_t position_ = 0;
};

}  // namespace kaamos::vulkan::testing

// Defines std::shared_ptr<Gpu> `name`, or ends the test.
#define KAAMOS_NEED_GPU(name)                                       \
  const ::kaamos::vulkan::testing::ValidationGuard guard_of_##name; \
  std::shared_ptr<::kaamos::vulkan::Gpu> name;                      \
  if (auto made_##name = ::kaamos::vulkan::Gpu::create()) {         \
    name = *made_##name;                                            \
  } else if (::kaamos::vulkan::testing::vulkan_is_required()) {     \
    FAIL() << made_##name.error().message;                          \
  } else {                                                          \
    GTEST_SKIP() << made_##name.error().message;                    \
  }                                                                 \
  static_assert(true)
