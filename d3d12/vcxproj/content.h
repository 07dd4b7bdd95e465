// SPDX-License-Identifier: MIT
//
// Files that a project copies beside its program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "d3d12/vcxproj/command.h"
#include "d3d12/vcxproj/evaluation.h"
#include "d3d12/vcxproj/project.h"

namespace kaamos::vcxproj {

// Returns a path below the project's $(OutDir) as one below the program's folder: "" for $(OutDir)
// itself. A path elsewhere keeps only its last name.
std::string below_output(const Evaluation& evaluation, std::string_view path);

// Whether an item of a content type is copied: Content and CopyFileToFolders are unless they say
// otherwise, others are where they say so.
bool is_copied(const Item& item);

std::string destination_of(const Evaluation& evaluation, const Item& item);

// What a copy command copies. Empty where its files do not exist.
std::vector<Content> contents_of_copy(const Evaluation& evaluation, const Command& command);

}  // namespace kaamos::vcxproj
