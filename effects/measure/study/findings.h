// SPDX-License-Identifier: MIT
// Says what a study found, in sentences made from its numbers.
#pragma once

#include <string>
#include <vector>

#include "effects/measure/study/result.h"

namespace kaamos::measure {

// "adaptive shadows, 5 rays at most".
std::string setting_name(const StudyRow& row);

// Returns the findings, in ten lines at most: what matters most comes first.
std::vector<std::string> study_findings(const std::vector<StudyResult>& results);

}  // namespace kaamos::measure
