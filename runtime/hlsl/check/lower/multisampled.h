// SPDX-License-Identifier: MIT
//
// Multisampled textures: every use is checked like DXC's, and removes the device where it runs,
// because no resource has samples yet. [HLSL: Texture2DMS, RWTexture2DMS]
#pragma once

#include <optional>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Multisampled : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value index_multisampled(const Value& base, const Value& index, SourceLocation location);
  std::optional<Value> call_multisampled_method(const Value& object, const NamePart& part,
                                                std::vector<Value>& arguments,
                                                SourceLocation location);

 private:
  Value multisampled_use(const Type* type, SourceLocation location);
};

}  // namespace kaamos::hlsl
