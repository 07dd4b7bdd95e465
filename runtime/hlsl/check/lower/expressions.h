// SPDX-License-Identifier: MIT
//
// Expressions of every kind: names, members, casts and constructors here, the others by the parts
// that know them.
#pragma once

#include <span>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Expressions : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value lower(const Expr* expression);
  std::vector<Value> lower_all(std::span<const Expr* const> expressions, bool keep_places,
                               bool save_values = false);
  Value split_value(const SplitPart& part, SourceLocation location);
  Value lower_this(SourceLocation location);
  Value lower_construct(const Type* type, std::span<const Expr* const> arguments,
                        SourceLocation location);

 private:
  Value lower_inner(const Expr* expression);
  Value lower_name(const NameExpr* expr);
  Value symbol_value(Symbol* symbol, SourceLocation location);
  Value variable_value(VariableInfo* variable, SourceLocation location);
  Value lower_member(const MemberExpr* expr);
  Value member_of(const Value& base, const QualifiedName& name);
  Value lower_index(const IndexExpr* expr);
  Value lower_cast(const CastExpr* expr);
  Value lower_sizeof(const SizeofExpr* expr);
};

}  // namespace kaamos::hlsl
