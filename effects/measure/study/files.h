// SPDX-License-Identifier: MIT
// Text files of a study.
#pragma once

#include <rtapi/rtapi.h>

#include <string>

namespace kaamos::measure {

// Whole or not at all.
rtapi::Status write_text(const std::string& path, const std::string& text);
// Empty where there is none.
std::string read_text(const std::string& path);

}  // namespace kaamos::measure
