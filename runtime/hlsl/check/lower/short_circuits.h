// SPDX-License-Identifier: MIT
//
// && || and ?:, which evaluate one side only if their condition is a scalar.
#pragma once

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class ShortCircuits : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value lower_logical(const BinaryExpr* expr);
  Value lower_conditional(const ConditionalExpr* expr);

 private:
  const Type* type_of_arms(const Value (&arms)[2], bool is_constant, SourceLocation location);
  Value choose(const ConditionalExpr* expr, const ir::Expr* chosen, const Value (&arms)[2],
               ir::Block (&blocks)[2]);
};

}  // namespace kaamos::hlsl
