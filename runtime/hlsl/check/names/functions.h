// SPDX-License-Identifier: MIT
//
// Functions, methods and their signatures.
#pragma once

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class Functions : NamesPart {
 public:
  using NamesPart::NamesPart;

  void declare_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner);
  FunctionInfo* make_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner);
  void resolve_signature(FunctionInfo* function);

 private:
  FunctionInfo* same_signature(Symbol* symbol, const FunctionInfo& function);
};

}  // namespace kaamos::hlsl
