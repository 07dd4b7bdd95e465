// SPDX-License-Identifier: MIT
/// @file
/// The version of Kaamos. CMakeLists.txt reads the three numbers from here, so that the package,
/// the library and the programs' --version agree; CHANGELOG.md says what changed.
#pragma once

#include <cstdint>

namespace rtapi {

/// The version of the headers that a program is compiled with: semantic versioning. Before 1.0.0 a
/// new minor version may break programs, a new patch version may not.
inline constexpr uint32_t kVersionMajor = 0;
inline constexpr uint32_t kVersionMinor = 1;  ///< [kVersionMajor]
inline constexpr uint32_t kVersionPatch = 0;  ///< [kVersionMajor]

/// The version of the library that the program runs with, such as "0.1.0". It differs from the
/// constants above only if headers and library come from different installations. The text lives as
/// long as the program. Needs no device, cannot fail, and may be called from any thread.
const char* GetVersion();

}  // namespace rtapi
