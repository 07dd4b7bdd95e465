// SPDX-License-Identifier: MIT
//
// Checks a module against the rules of ir.h. For tests: the checker must never break one, whatever
// its input.
#pragma once

#include <string>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Empty, or the first broken rules, one per line.
std::string verify(const ir::Module& module);

}  // namespace kaamos::hlsl
