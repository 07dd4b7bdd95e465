// SPDX-License-Identifier: MIT
//
// Operators, those that structs define too; && || ?: are with ShortCircuits.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Operators : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value lower_unary(const UnaryExpr* expr);
  Value lower_binary(const BinaryExpr* expr);
  Value lower_assign(const AssignExpr* expr);
  Value binary_value(BinaryOp op, const Value& left, const Value& right, SourceLocation location);
  // The type that operands of the two are converted to; null if there is none, which common_type
  // reports. `truncates`: one of the two loses components.
  const Type* find_common_type(const Type* a, const Type* b, bool& truncates);
  // The same for arguments of an intrinsic function: of two matrices, what both have.
  const Type* find_joined_type(const Type* a, const Type* b, bool& truncates);
  const Type* common_type(const Type* a, const Type* b, SourceLocation location, bool& truncates);
  std::optional<Value> overloaded_operator(std::string_view name, const Value& left,
                                           std::vector<Value> arguments, SourceLocation location);

 private:
  Value assign_through_cast(const AssignExpr* expr, const Value& target, Value value);
  Value lower_increment(const UnaryExpr* expr, const Value& operand);
};

}  // namespace kaamos::hlsl
