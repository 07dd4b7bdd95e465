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
  // Returns whether a template of the symbol is the same one; one of the two has no body.
  bool join_template(Symbol* symbol, const FunctionInfo& function);
  FunctionInfo* same_signature(Symbol* symbol, const FunctionInfo& function);
};

}  // namespace kaamos::hlsl
