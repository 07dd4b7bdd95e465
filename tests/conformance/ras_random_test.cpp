// SPDX-License-Identifier: MIT
//
// Random triangles and the closed mesh on each backend: 2,000 triangles of each setting, 100,000
// with KAAMOS_FULL=1.
#include <gtest/gtest.h>

#include "tests/conformance/rules_hold.h"

namespace kaamos::conformance {
namespace {

const bool kRandomRegistered = [] {
  Target vulkan;
  vulkan.backend = "vulkan";
  for (const Target& target : {Target(), vulkan}) {
    const std::string suite = "RandomTriangles_" + target.backend;
    testing::RegisterTest(suite.c_str(), "all", nullptr, nullptr, __FILE__, __LINE__,
                          [=]() -> RulesHold* {
                            return new RulesHold({"ras_random", ras_random_tests()}, target);
                          });
  }
  return true;
}();

TEST(RandomTriangles, AreRegistered) {
  EXPECT_TRUE(kRandomRegistered);
}

}  // namespace
}  // namespace kaamos::conformance
