// SPDX-License-Identifier: MIT
//
// Methods and elements of resources; those of textures are with Textures.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Resources : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value index_resource(const Value& base, const Value& index, SourceLocation location);
  Value call_resource_method(const Value& object, const NamePart& part,
                             std::vector<Value>& arguments, SourceLocation location);
  Value texel(const ir::Expr* resource, const Type* type, const ir::Expr* coordinates,
              const ir::Expr* mip, bool is_const);
  const ir::Expr* to_vector(const Value& value, Scalar scalar, uint32_t size,
                            SourceLocation location);

 private:
  std::optional<Value> call_raw_method(const Value& object, const NamePart& part,
                                       std::vector<Value>& arguments, SourceLocation location);
};

}  // namespace kaamos::hlsl
