// SPDX-License-Identifier: MIT
// From tokens to a syntax tree.
#pragma once

#include "runtime/hlsl/front/ast.h"
#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/front/token.h"

namespace kaamos::hlsl {

// Parses what preprocess_file() returned. The result is never null and always well formed: a part
// with an error is left out or becomes an ErrorExpr, an ErrorStmt or a type of kind kError, so
// later stages can walk the tree whatever the input was. No path through expressions, statements
// and nested declarations is longer than a few thousand nodes. The tree lives in `arena` and points
// into the texts of the tokens.
const TranslationUnit* parse(const TokenList& tokens, AstArena& arena,
                             DiagnosticEngine& diagnostics);

}  // namespace kaamos::hlsl
