// SPDX-License-Identifier: MIT
//
// The intermediate representation as text, for people and tests.
#pragma once

#include <string>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

std::string dump(const ir::Module& module);
std::string dump(const ir::Function& function);
std::string dump(const ir::Expr& expression);
std::string dump(const ir::Type& type);

}  // namespace kaamos::hlsl
