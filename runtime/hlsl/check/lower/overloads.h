// SPDX-License-Identifier: MIT
//
// Overload resolution: a call means the function whose conversions cost least in sum. OVERLOADS.md
#pragma once

#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Overloads : LowerPart {
 public:
  using LowerPart::LowerPart;

  // `cost`, if not null, becomes what the function's conversions cost.
  FunctionInfo* resolve_overload(const std::vector<FunctionInfo*>& candidates, const NamePart& part,
                                 const std::vector<Value>& arguments, SourceLocation location,
                                 bool quiet, ConversionCost* cost = nullptr);

 private:
  bool is_viable(FunctionInfo* function, const std::vector<Value>& arguments, ConversionCost& cost);
};

}  // namespace kaamos::hlsl
