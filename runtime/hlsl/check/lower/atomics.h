// SPDX-License-Identifier: MIT
//
// Interlocked functions and methods.
#pragma once

#include <span>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

class Atomics : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value call_interlocked(const AtomicRule& rule, std::vector<Value>& arguments,
                         SourceLocation location);
  Value emit_atomic(const AtomicRule& rule, ir::Stmt* statement, const Type* type,
                    std::span<Value> arguments, SourceLocation location);
};

}  // namespace kaamos::hlsl
