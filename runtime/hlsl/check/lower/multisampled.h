// SPDX-License-Identifier: MIT
//
// Multisampled textures. Those that are writable are checked like DXC's, and a use removes the
// device where it runs, because no such resource has samples. [HLSL: Texture2DMS, RWTexture2DMS]
#pragma once

#include <optional>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Multisampled : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value index_multisampled(const Value& base, const Value& index, SourceLocation location);
  // float2 of a sample of `count`, from the middle of the pixel, in pixels; 0 if there is none.
  const ir::Expr* sample_position(const ir::Expr* count, const ir::Expr* index);
  std::optional<Value> call_multisampled_method(const Value& object, const NamePart& part,
                                                std::vector<Value>& arguments,
                                                SourceLocation location);

 private:
  Value multisampled_use(const Type* type, SourceLocation location);
  // A texel of a texture that is not writable; `offset` may be null.
  Value texel(const ir::Expr* resource, const Type* type, const ir::Expr* coordinates,
              const ir::Expr* sample, const ir::Expr* offset, SourceLocation location);
  Value dimensions(const Value& object, std::vector<Value>& arguments, SourceLocation location);
};

}  // namespace kaamos::hlsl
