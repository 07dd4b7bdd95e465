// SPDX-License-Identifier: MIT
//
// Holds a module against the rules of ir.h. For tests: the checker must never break one, whatever
// it was given.
#pragma once

#include <string>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Empty, or the first rules that are broken, one a line.
std::string verify(const ir::Module& module);

}  // namespace kaamos::hlsl
