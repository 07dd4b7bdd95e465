// SPDX-License-Identifier: MIT
//
// Templates of structs, aliases and functions: one copy per set of arguments.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class Templates : NamesPart {
 public:
  using NamesPart::NamesPart;

  StructTemplate* template_of(const Symbol* symbol, const NamePart& part);
  StructInfo* instantiate_struct(StructTemplate* structure, const NamePart& part,
                                 SourceLocation location, Scope* scope);
  const Type* instantiate_alias(const TypeAliasDecl* alias, Scope* alias_scope,
                                const NamePart& part, Scope* scope);
  FunctionInfo* instantiate_function(FunctionInfo* function,
                                     std::span<const TemplateArgument> written, Scope* use_scope,
                                     const std::vector<Value>& arguments);
  // Returns false if an argument is missing or of the wrong kind.
  bool bind_arguments(std::span<const TemplateParameter> parameters,
                      std::span<const TemplateArgument> written, Scope* use_scope,
                      TemplateValues& values);
  bool complete_arguments(std::span<const TemplateParameter> parameters, Scope* scope,
                          TemplateValues& values);
  Scope* template_scope(std::span<const TemplateParameter> parameters, const TemplateValues& values,
                        Scope* parent);
  std::string template_suffix(const TemplateValues& values);
  bool deduce(const TypeSyntax* syntax, const Type* type,
              std::span<const TemplateParameter> parameters, TemplateValues& values);
  void deduce_value(const Expr* expression, uint64_t value,
                    std::span<const TemplateParameter> parameters, TemplateValues& values);

 private:
  int template_depth_ = 0;
};

}  // namespace kaamos::hlsl
