// SPDX-License-Identifier: MIT
//
// The names by which sources include headers that hold compiled shaders.
#pragma once

#include "d3d12/vcxproj/project.h"

namespace kaamos::vcxproj {

// Sets `header` of each shader that has a `header_path`: as the project's sources include it, else
// below the longest include folder, else below the project's folder, else its name alone.
void name_generated_headers(Project& project);

}  // namespace kaamos::vcxproj
