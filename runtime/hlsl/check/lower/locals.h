// SPDX-License-Identifier: MIT
//
// Variables of a body.
#pragma once

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Locals : LowerPart {
 public:
  using LowerPart::LowerPart;

  void lower_local(const VariableDecl* decl);
  void declare_variable(VariableInfo* info);
  const ir::Expr* initial_value(const Expr* initialiser, const Type* type);

 private:
  void lower_local_static(const VariableDecl* decl, const Type* type);
  bool is_result_of_last_call(const ir::Expr* value) const;
};

}  // namespace kaamos::hlsl
