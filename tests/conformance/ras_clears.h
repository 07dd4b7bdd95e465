// SPDX-License-Identifier: MIT
//
// The tests of target views, which belong to the section of clears.
#pragma once

#include <rtapi/upload.h>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

std::vector<RuleTest> ras_view_tests();

}  // namespace kaamos::conformance
