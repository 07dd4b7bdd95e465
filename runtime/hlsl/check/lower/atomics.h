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
  // `type` is that of the memory; min and max go by its sign.
  Value emit_atomic(const AtomicRule& rule, ir::Stmt* statement, const Type* type, bool is_method,
                    std::span<Value> arguments, SourceLocation location);
  // The type as which DXC takes an argument that may be a signed or an unsigned integer of `bytes`.
  const Type* any_integer(const Type* given, uint32_t bytes);

 private:
  // Floats in memory are exchanged `as_bits`.
  const ir::Expr* operand(const AtomicRule& rule, const Value& argument, const Type* type,
                          bool is_compared, bool as_bits);
};

}  // namespace kaamos::hlsl
