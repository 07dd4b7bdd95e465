// SPDX-License-Identifier: MIT
//
// Bit fields: places that are part of a field of the IR.
#pragma once

#include <string_view>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class BitFields : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value bit_field_of(const Value& owner, const FieldInfo& field);
  static Value unit_of(const Value& value);
  const ir::Expr* extract_bits(const ir::Expr* unit, const FieldInfo& field);
  const ir::Expr* insert_bits(const ir::Expr* unit, const FieldInfo& field, const ir::Expr* value);
  bool require_whole_field(const Value& value, SourceLocation location, std::string_view purpose);
};

}  // namespace kaamos::hlsl
