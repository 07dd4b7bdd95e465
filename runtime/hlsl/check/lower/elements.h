// SPDX-License-Identifier: MIT
//
// Elements of arrays, rows of matrices, components of vectors: places inside other places.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Elements : LowerPart {
 public:
  using LowerPart::LowerPart;

  const ir::Expr* index_value(const Value& value, SourceLocation location);
  Value element_of(const Value& base, const Value& index, SourceLocation location);
  Value swizzle_of(const Value& base, std::string_view text, SourceLocation location);
  Value matrix_swizzle_of(const Value& base, std::string_view text, SourceLocation location);
  Value component_of(const Value& base, const std::vector<uint8_t>& components);

 private:
  const Type* row_type(const Type* matrix);
  Value memory_element(const Value& base, const ir::Expr* index);
};

}  // namespace kaamos::hlsl
