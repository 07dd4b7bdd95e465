// SPDX-License-Identifier: MIT
// From tokens to the syntax tree.
#pragma once

#include "runtime/hlsl/front/ast.h"
#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/front/token.h"

namespace kaamos::hlsl {

// Parses what preprocess_file() returned. Never null and never incomplete in itself: a part that
// was diagnosed is left out or stands as an ErrorExpr, an ErrorStmt or a type of kind kError, so
// later stages may walk the tree whatever the input was; no path through expressions, statements
// and nested declarations is longer than a few thousand nodes. The tree lives in `arena` and points
// into the texts of the tokens.
const TranslationUnit* parse(const TokenList& tokens, AstArena& arena,
                             DiagnosticEngine& diagnostics);

}  // namespace kaamos::hlsl
