// SPDX-License-Identifier: MIT
//
// Adds to a scope what a declaration of any kind declares, and what is built in.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class Declarations : NamesPart {
 public:
  using NamesPart::NamesPart;

  void declare_builtins();
  void declare_all(std::span<const Decl* const> declarations, Scope* scope);
  void declare(const Decl* declaration, Scope* scope);

 private:
  using BuiltinFields = std::initializer_list<std::pair<std::string_view, const Type*>>;
  StructInfo* declare_builtin_struct(Scope* scope, std::string_view name, BuiltinFields fields);
  void declare_hit_object();
  void declare_namespace(const NamespaceDecl* decl, Scope* scope);
  void declare_alias(const TypeAliasDecl* decl, Scope* scope);
  void declare_using(const QualifiedName& name, Scope* scope, SourceLocation location);
};

}  // namespace kaamos::hlsl
