// SPDX-License-Identifier: MIT
//
// The environment, and programs that are run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace kaamos::hlsl {

// The value of an environment variable; empty if it is not set.
std::string environment(const char* name);

// The program's full path; a name without a slash is searched for in $PATH. Empty if there is none.
std::filesystem::path find_program(const std::string& name);

// Runs a program until it exits, with its output going to `log`. Returns its exit code, or -1 with
// errno.
int run_program(const std::vector<std::string>& words, const std::filesystem::path& log);

}  // namespace kaamos::hlsl
