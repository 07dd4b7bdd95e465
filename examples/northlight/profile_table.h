// SPDX-License-Identifier: MIT
// The table of --profile.
#pragma once

#include <string>
#include <vector>

#include "effects/engine/profile.h"

namespace northlight {

// A line for each step of each part of a run, a sum for each part and one for all.
std::string print_profile(const std::vector<kaamos::effects::ProfileStep>& steps);

}  // namespace northlight
