// SPDX-License-Identifier: MIT
//
// Resolves what names and types mean, as they are written at a place in the source.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "runtime/hlsl/check/names/names_part.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

class Resolver : NamesPart {
 public:
  using NamesPart::NamesPart;

  // Reports what is missing, unless `quiet`.
  Symbol* resolve_name(const QualifiedName& name, Scope* scope, bool quiet);
  Scope* scope_of_part(const NamePart& part, Symbol* symbol, Scope* scope);
  const Type* resolve_type(const TypeSyntax* syntax, Scope* scope);
  // The type of a variable; `auto` takes that of the initialiser.
  const Type* resolve_variable_type(const VariableDecl* decl, Scope* scope);
  const Type* type_argument(const TemplateArgument& argument, Scope* scope);
  std::optional<int64_t> value_argument(const TemplateArgument& argument, Scope* scope,
                                        const Type** type = nullptr);
  // Whether a type belongs to a stage that is not offered, as TriangleStream does.
  bool is_of_other_stage(const TypeSyntax* syntax, Scope* scope);
  // Whether `#pragma pack_matrix` at the place of a matrix's name decides on its order.
  bool lacks_matrix_order(const TypeSyntax* syntax, Scope* scope);

 private:
  const Type* check_norm(const TypeSyntax* syntax, const Type* type);
  const Type* unsigned_twin(const TypeSyntax* syntax, const Type* type);
  const Type* resolve_named(const TypeSyntax* syntax, Scope* scope);
  const Type* resolve_builtin(const NamePart& part, SourceLocation location, Scope* scope);
  const Type* resolve_stream(const NamePart& part, Scope* scope);
  const Type* resolve_ray_query(const NamePart& part, Scope* scope);
  const Type* resolve_resource(const ResourceTraits& traits, const NamePart& part, Scope* scope);
  const Type* resolve_array(const TypeSyntax* syntax, Scope* scope);
  const Type* apply_storage(const Type* type, Modifiers modifiers);
  Scalar scalar_of(ScalarKind kind, SourceLocation location);

  // By corners and type of vertex.
  std::map<std::pair<uint32_t, const Type*>, StructInfo*> streams_;
};

}  // namespace kaamos::hlsl
