// SPDX-License-Identifier: MIT
//
// What a project's ClCompile settings are for clang.
#pragma once

#include "d3d12/vcxproj/evaluation.h"
#include "d3d12/vcxproj/project.h"

namespace kaamos::vcxproj {

// Adds include folders, definitions, forced includes and options. kaamos_add_d3d12_program has one
// set for all sources, so what one source has of its own goes to all, with a note.
void add_host_options(const Evaluation& evaluation, Project& project, Notes& notes);

// Those of `list` that exist. Others are noted unless the build makes them: below $(IntDir) or
// $(OutDir).
std::vector<std::filesystem::path> include_folders(const Evaluation& evaluation,
                                                   std::string_view list, Notes& notes);

}  // namespace kaamos::vcxproj
