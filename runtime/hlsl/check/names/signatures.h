// SPDX-License-Identifier: MIT
//
// Signatures of functions, compared and in words.
#pragma once

#include <string>

#include "runtime/hlsl/check/names/symbols.h"

namespace kaamos::hlsl {

// Returns whether the types and directions agree.
bool have_same_parameters(const FunctionInfo& one, const FunctionInfo& other);
// As in messages: "float f(inout Payload)".
// Whether two function templates declare the same one.
bool are_written_alike(const FunctionDecl& one, const FunctionDecl& other);
std::string describe(const FunctionInfo& function);

}  // namespace kaamos::hlsl
