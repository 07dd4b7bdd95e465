// SPDX-License-Identifier: MIT
//
// What DXC's validator asks of bodies, beyond the rules of the language.
#pragma once

#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class BodyRules : LowerPart {
 public:
  using LowerPart::LowerPart;

  // A variable that was declared without a value in the body that is being lowered.
  void note_without_value(const VariableInfo& variable, SourceLocation location);
  // Reports variables that are read and never written, and out parameters that are never written.
  void check_variables(const FunctionInfo& function);
  // Reports a loop that nothing ends.
  void check_loop(const ir::Stmt& loop, SourceLocation location);
  // Reports an [unroll] without a number on a loop that counts up to what memory holds.
  void check_unroll(const ir::Stmt& loop, SourceLocation location);
  // Reports a built-in name that the target's shader model does not have.
  void check_model(std::string_view name, SourceLocation location);
  static bool has_return(const ir::Block& block);
  // Reports integers divided by a constant zero.
  void check_divisor(ir::BinaryOp op, const ir::Expr* right, SourceLocation location);

 private:
  bool is_entry_point() const;

  struct Noted {
    const ir::Variable* variable;
    std::string_view name;
    SourceLocation location;
  };
  std::unordered_map<const FunctionInfo*, std::vector<Noted>> noted_;
};

}  // namespace kaamos::hlsl
