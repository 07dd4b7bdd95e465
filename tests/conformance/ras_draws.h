// SPDX-License-Identifier: MIT
//
// The tests of ras_draw_tests that are about indirect draws, queries, predication and
// planes of depth and stencil.
#pragma once

#include <rtapi/upload.h>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

std::vector<RuleTest> ras_indirect_tests();
std::vector<RuleTest> ras_query_tests();
std::vector<RuleTest> ras_predication_tests();
std::vector<RuleTest> ras_plane_tests();

}  // namespace kaamos::conformance
