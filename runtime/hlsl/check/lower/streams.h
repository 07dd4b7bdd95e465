// SPDX-License-Identifier: MIT
//
// Append and RestartStrip of the streams that geometry shaders write. [D3D11.3: 13.5]
#pragma once

#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Streams : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value call_method(const Value& stream, const NamePart& part, std::vector<Value>& arguments,
                    SourceLocation location);

 private:
  // The scalars and vectors of a vertex, in the order of the shader's outputs.
  void take_apart(const Type* type, const ir::Expr* value, std::vector<const ir::Expr*>& parts);
};

}  // namespace kaamos::hlsl
