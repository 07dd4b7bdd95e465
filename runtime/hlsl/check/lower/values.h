// SPDX-License-Identifier: MIT
//
// Making values.
#pragma once

#include "runtime/hlsl/check/names/symbols.h"

namespace kaamos::hlsl {

inline Value error_value() {
  return Value{};
}

inline Value rvalue(const ir::Expr* expr, const Type* type) {
  if (!expr) return error_value();
  Value value;
  value.kind = ValueKind::kExpr;
  value.type = type;
  value.expr = expr;
  return value;
}

inline Value memory(const ir::Expr* resource, const ir::Expr* element, const ir::Expr* offset,
                    const Type* type, ir::Layout layout, bool is_const) {
  Value value;
  value.kind = ValueKind::kMemory;
  value.type = type;
  value.is_place = true;
  value.is_const = is_const;
  value.expr = resource;
  value.element = element;
  value.offset = offset;
  value.layout = layout;
  return value;
}

}  // namespace kaamos::hlsl
