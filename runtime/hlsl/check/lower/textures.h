// SPDX-License-Identifier: MIT
//
// Methods of textures and typed buffers, and texels with components of 64 bits.
#pragma once

#include <optional>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

class Textures : LowerPart {
 public:
  using LowerPart::LowerPart;

  std::optional<Value> call_texture_method(const Value& object, const NamePart& part,
                                           std::vector<Value>& arguments, SourceLocation location);
  // The result of a load or sample, whose last argument takes the status.
  Value with_status(const Value& result, Value& status);
  Value call_dimensions(const Value& object, std::vector<Value>& arguments,
                        SourceLocation location);
  const ir::Expr* from_texel(const ir::Expr* raw, const Type* type);
  const ir::Expr* to_texel(const ir::Expr* value, const Type* type);

 private:
  void check_offset(const ir::Expr* offset, SourceLocation location);
  Value call_load(const Value& object, std::vector<Value>& arguments, SourceLocation location);
  Value call_sample(const Value& object, const SampleRule& rule, std::vector<Value>& arguments,
                    SourceLocation location);
  Value gather_four(const Value& object, const SampleRule& rule, std::vector<Value>& arguments,
                    size_t fixed, SourceLocation location);
};

}  // namespace kaamos::hlsl
