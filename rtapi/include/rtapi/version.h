// SPDX-License-Identifier: MIT
//
// Which Kaamos this is. CMakeLists.txt reads the three numbers from here, so that the package, the
// library and the programs' --version say the same; CHANGELOG.md says what changed.
#pragma once

#include <cstdint>

namespace rtapi {

// Semantic versioning; before 1.0.0 a new minor version may break programs, a new patch may not.
inline constexpr uint32_t kVersionMajor = 0;
inline constexpr uint32_t kVersionMinor = 1;
inline constexpr uint32_t kVersionPatch = 0;

// The version of the library that the program runs with, e.g. "0.1.0", valid for the whole run. The
// constants above are those of the headers it was compiled with; they differ only where the two
// come from different installations. Needs no device, cannot fail, and any thread may call it.
const char* GetVersion();

}  // namespace rtapi
