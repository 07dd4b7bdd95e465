// SPDX-License-Identifier: MIT
//
// The CMakeLists.txt of an imported project.
#pragma once

#include <filesystem>
#include <string>

#include "d3d12/vcxproj/project.h"

namespace kaamos::vcxproj {

// A CMake argument, in quotation marks where it needs them. "${CMAKE_CURRENT_SOURCE_DIR}" stays a
// reference only where the caller adds it.
std::string cmake_argument(const std::string& text);

// The text for a file in `folder`, which paths are relative to. `version` is Kaamos'.
std::string cmake_lists(const Project& project, const std::filesystem::path& folder,
                        const std::string& version);

}  // namespace kaamos::vcxproj
