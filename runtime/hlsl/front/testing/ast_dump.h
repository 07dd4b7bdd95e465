// SPDX-License-Identifier: MIT
// The syntax tree as text, for the parser's tests. Expressions are printed as
// (operator operand ...), each statement and declaration on its own line.
#pragma once

#include <string>

#include "runtime/hlsl/front/ast.h"

namespace kaamos::hlsl {

std::string dump(const TranslationUnit& unit);
std::string dump(const Decl& decl);
std::string dump(const Stmt& stmt);
std::string dump(const Expr& expr);
std::string dump(const TypeSyntax& type);

}  // namespace kaamos::hlsl
