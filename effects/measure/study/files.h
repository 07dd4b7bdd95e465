// SPDX-License-Identifier: MIT
// Text files of a study.
#pragma once

#include <string>

namespace kaamos::measure {

// The contents of a file, empty where there is none.
std::string read_text(const std::string& path);

}  // namespace kaamos::measure
