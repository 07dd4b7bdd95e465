// SPDX-License-Identifier: MIT
//
// Variables outside of functions.
#pragma once

#include <string_view>

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class Variables : NamesPart {
 public:
  using NamesPart::NamesPart;

  void declare_variable(const VariableDecl* decl, Scope* scope);
  void declare_static(const VariableDecl* decl, const Type* type, Scope* scope);
  bool check_variable_type(const Type* type, SourceLocation location, std::string_view name);
};

}  // namespace kaamos::hlsl
