// SPDX-License-Identifier: MIT
//
// Shaders of a project: FxCompile items and calls of dxc.
#pragma once

#include <filesystem>
#include <optional>

#include "d3d12/vcxproj/command.h"
#include "d3d12/vcxproj/evaluation.h"
#include "d3d12/vcxproj/project.h"

namespace kaamos::vcxproj {

// Nothing, with a note, where Kaamos does not compile the stage. `file` is the item's file.
std::optional<Shader> shader_of_item(const Evaluation& evaluation, const Item& item,
                                     const std::filesystem::path& file, Notes& notes);

// The same of a call of dxc in the commands of `item`.
std::optional<Shader> shader_of_command(const Evaluation& evaluation, const Item& item,
                                        const Command& command, Notes& notes);

}  // namespace kaamos::vcxproj
