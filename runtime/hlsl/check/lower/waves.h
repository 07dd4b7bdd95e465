// SPDX-License-Identifier: MIT
//
// Wave and quad intrinsics. In compute shaders, and those of quads in pixel shaders, each becomes a
// statement; in ray tracing and vertex shaders each thread is a wave of its own, which DXR allows,
// since waves may be re-formed at every trace and call, and the statement becomes an assignment.
// [DXR: Wave intrinsics]
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

class Waves : LowerPart {
 public:
  using LowerPart::LowerPart;

  std::optional<Value> call_wave(std::string_view name, std::vector<Value>& arguments,
                                 SourceLocation location);

 private:
  const Type* wave_operand_type(const WaveRule& rule, const Value& argument);
  const ir::Expr* emit_wave(shader::WaveOp op, std::vector<const ir::Expr*> operands,
                            const Type* type);
  const ir::Expr* emit_wave_of_rows(shader::WaveOp op, const std::vector<const ir::Expr*>& operands,
                                    const Type* from, const Type* type);
};

}  // namespace kaamos::hlsl
