// SPDX-License-Identifier: MIT
//
// Functions that the tests of depth share.
#pragma once

#include <vector>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

// The target from side to side; z goes from `left` to `right`.
std::vector<Corner> slope_over(const Screen& screen, float left, float right);
// The tests of ras_depth_tests that are about depth bias.
std::vector<RuleTest> ras_depth_bias_tests();
RuleTest ras_stencil_test();
RuleTest ras_multisample_test();
RuleTest ras_multisample_lines_test();

}  // namespace kaamos::conformance
