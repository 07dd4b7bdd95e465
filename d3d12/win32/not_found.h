// SPDX-License-Identifier: MIT
// Files and libraries that the program asked for in vain. Many programs do, and go on; one that
// fails gets the list.
#pragma once

#include <string>

namespace kaamos::d3d12 {

/// Remembers a name, and reports KA4043 the first time: "call: `name` was not found."
void tell_not_found(const std::string& call, const std::string& name);

/// Prints what was remembered since the last call, if anything was and anything is printed at all:
/// for programs that fail.
void print_not_found();

}  // namespace kaamos::d3d12
