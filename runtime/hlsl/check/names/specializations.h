// SPDX-License-Identifier: MIT
//
// Specializations of templates, and members that are defined outside of their structs.
#pragma once

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class Specializations : NamesPart {
 public:
  using NamesPart::NamesPart;

  void specialize_struct(const StructDecl* decl, Scope* scope);
  void specialize_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner);
  // The partial specialization that fits best, with its parameters' values; null: the primary.
  const StructDecl* partial_for(StructTemplate* structure, const TemplateValues& values,
                                SourceLocation location, TemplateValues& found);
  StructTemplate* outer_template(const QualifiedName& qualifier, Scope* scope);
  void declare_outer(StructTemplate* structure, const OuterMember& member);
  void apply_outer(StructInfo* info, const TemplateValues& values, const OuterMember& member);
  void declare_outer_static(const VariableDecl* decl, Scope* scope);
  FunctionInfo* same_parameters(Symbol* symbol, const FunctionInfo& function);
  static void define(FunctionInfo* function, const FunctionDecl* decl, Scope* scope);

 private:
  bool match_partial(StructTemplate* structure, const StructDecl* partial,
                     const TemplateValues& values, TemplateValues& found);
  void define_static(VariableInfo* variable, const VariableDecl* decl, Scope* scope);
};

}  // namespace kaamos::hlsl
