// SPDX-License-Identifier: MIT
//
// DebugBreak and dx::IsDebuggingEnabled. [HLSL: DebugBreak]
#pragma once

#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Debugging : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value call_break(const std::vector<Value>& arguments, SourceLocation location);
  Value call_is_enabled(const std::vector<Value>& arguments, SourceLocation location);
};

}  // namespace kaamos::hlsl
