// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/declarations.h"

#include <algorithm>

#include "kaamos/shader/abi.h"
#include "runtime/hlsl/check/names/name_parts.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

StructInfo* Declarations::declare_builtin_struct(Scope* scope, std::string_view name,
                                                 BuiltinFields fields) {
  StructInfo* info = parts_.structs.make_struct(nullptr, scope, std::string(name));
  for (const auto& [field_name, type] : fields) {
    FieldInfo& field = info->fields.emplace_back();
    field.name = field_name;
    field.type = type;
    field.index = static_cast<uint32_t>(info->ir->fields.size());
    ir::Field& ir_field = info->ir->fields.emplace_back();
    ir_field.name = field_name;
    ir_field.type = type->ir;
    Symbol* symbol = scopes_.add_symbol(info->scope, SymbolKind::kField, field_name, {});
    symbol->field = field.index;
  }
  info->complete = true;
  Symbol* symbol = scopes_.add_symbol(scope, SymbolKind::kType, name, {});
  symbol->type = info->type;
  symbol->scope = info->scope;
  return info;
}

// Its members are in the IR alone, where shaders cannot name them. [ir/hit_object.h]
void Declarations::declare_hit_object() {
  Scope* dx = scopes_.make_scope(ScopeKind::kNamespace, program_.global, "dx");
  scopes_.add_symbol(program_.global, SymbolKind::kNamespace, "dx", {})->scope = dx;
  scopes_.add_symbol(dx, SymbolKind::kFunctions, "MaybeReorderThread", {});
  if (shader_model_minor(program_.options->target) >= 10) {
    scopes_.add_symbol(dx, SymbolKind::kFunctions, "IsDebuggingEnabled", {});
  }
  StructInfo* info = program_.hit_object = declare_builtin_struct(dx, "HitObject", {});
  info->is_hit_object = true;
  bench_.module.hit_object = info->ir;
  const Type* number = types_.scalar(Scalar::kUint32);
  const Type* scalar = types_.scalar(Scalar::kFloat32);
  const Type* vector = types_.vector(Scalar::kFloat32, 3);
  const Type* matrix = types_.matrix(Scalar::kFloat32, 3, 4);
  const std::pair<std::string_view, const Type*> fields[] = {
      {"state", number},           {"ray_flags", number},
      {"origin", vector},          {"t_min", scalar},
      {"direction", vector},       {"t", scalar},
      {"instance_index", number},  {"instance_id", number},
      {"geometry_index", number},  {"primitive_index", number},
      {"hit_kind", number},        {"is_bound", number},
      {"record", number},          {"attributes", types_.array(number, shader::kHitAttributeWords)},
      {"object_to_world", matrix}, {"world_to_object", matrix},
  };
  for (const auto& [name, type] : fields) {
    ir::Field& field = info->ir->fields.emplace_back();
    field.name = name;
    field.type = type->ir;
  }
}

void Declarations::declare_builtins() {
  const Type* scalar = types_.scalar(Scalar::kFloat32);
  const Type* vector = types_.vector(Scalar::kFloat32, 3);
  program_.ray_desc = declare_builtin_struct(
      program_.global, "RayDesc",
      {{"Origin", vector}, {"TMin", scalar}, {"Direction", vector}, {"TMax", scalar}});
  bench_.module.ray_desc = program_.ray_desc->ir;
  declare_builtin_struct(program_.global, "BuiltInTriangleIntersectionAttributes",
                         {{"barycentrics", types_.vector(Scalar::kFloat32, 2)}});
  if (shader_model_minor(program_.options->target) >= 9) declare_hit_object();
  if (shader_model_minor(program_.options->target) >= 10) {
    program_.triangle_positions =
        declare_builtin_struct(program_.global, "BuiltInTrianglePositions",
                               {{"p0", vector}, {"p1", vector}, {"p2", vector}});
  }
  const Type* flags = types_.scalar(Scalar::kUint32);
  for (size_t i = 0; i < kBuiltinConstantCount; ++i) {
    if (kBuiltinConstants[i].minor > shader_model_minor(program_.options->target)) continue;
    Symbol* symbol =
        scopes_.add_symbol(program_.global, SymbolKind::kConstant, kBuiltinConstants[i].name, {});
    symbol->type = flags;
    symbol->value = build_.uint32(kBuiltinConstants[i].value);
  }
  for (const std::string_view name :
       {"RAY_FLAG", "RAYQUERY_FLAG", "CANDIDATE_TYPE", "COMMITTED_STATUS"}) {
    scopes_.add_symbol(program_.global, SymbolKind::kType, name, {})->type = flags;
  }
}

void Declarations::declare_all(std::span<const Decl* const> declarations, Scope* scope) {
  for (const Decl* declaration : declarations) declare(declaration, scope);
}

void Declarations::declare(const Decl* declaration, Scope* scope) {
  if (bench_.depth > 100) return;
  ++bench_.depth;
  switch (declaration->kind) {
    case DeclKind::kVariable:
      parts_.variables.declare_variable(static_cast<const VariableDecl*>(declaration), scope);
      break;
    case DeclKind::kFunction:
      parts_.functions.declare_function(static_cast<const FunctionDecl*>(declaration), scope,
                                        nullptr);
      break;
    case DeclKind::kStruct:
      parts_.structs.declare_struct(static_cast<const StructDecl*>(declaration), scope);
      break;
    case DeclKind::kEnum:
      parts_.enums.declare_enum(static_cast<const EnumDecl*>(declaration), scope);
      break;
    case DeclKind::kBuffer:
      parts_.bindings.declare_buffer(static_cast<const BufferDecl*>(declaration), scope);
      break;
    case DeclKind::kNamespace:
      declare_namespace(static_cast<const NamespaceDecl*>(declaration), scope);
      break;
    case DeclKind::kTypeAlias:
      declare_alias(static_cast<const TypeAliasDecl*>(declaration), scope);
      break;
    case DeclKind::kUsingNamespace: {
      const auto* decl = static_cast<const UsingNamespaceDecl*>(declaration);
      // `dx` exists before Shader Model 6.9, where it is empty.
      const bool is_dx = decl->target->is_simple() && decl->target->last().identifier == "dx";
      Symbol* symbol = parts_.resolver.resolve_name(*decl->target, scope, is_dx);
      if (symbol && symbol->kind != SymbolKind::kNamespace) {
        report(CheckId::kNotANamespace, decl->location, {Scopes::spell(*decl->target)});
      } else if (symbol) {
        scope->used.push_back(symbol->scope);
      }
      break;
    }
    case DeclKind::kUsing: {
      const auto* decl = static_cast<const UsingDecl*>(declaration);
      declare_using(*decl->target, scope, decl->location);
      break;
    }
    case DeclKind::kSubobject:
      parts_.on_subobject(static_cast<const SubobjectDecl*>(declaration));
      break;
    case DeclKind::kStaticAssert: {
      const auto* decl = static_cast<const StaticAssertDecl*>(declaration);
      const auto holds = parts_.evaluator.constant_integer(decl->condition, scope,
                                                           "the condition of _Static_assert");
      if (holds && *holds == 0) {
        report(CheckId::kStaticAssert, decl->location, {std::string(decl->text)});
      }
      break;
    }
    case DeclKind::kParameter:
      break;
  }
  --bench_.depth;
}

void Declarations::declare_namespace(const NamespaceDecl* decl, Scope* scope) {
  Symbol* symbol = decl->name.empty() ? nullptr : scopes_.find_local(scope, decl->name);
  if (symbol && symbol->kind != SymbolKind::kNamespace) {
    report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    return;
  }
  if (!symbol) {
    Scope* inner = scopes_.make_scope(ScopeKind::kNamespace, scope, decl->name);
    if (decl->name.empty()) {
      scope->used.push_back(inner);
      declare_all(decl->declarations, inner);
      return;
    }
    symbol = scopes_.add_symbol(scope, SymbolKind::kNamespace, decl->name, decl->location);
    symbol->scope = inner;
  }
  declare_all(decl->declarations, symbol->scope);
}

void Declarations::declare_alias(const TypeAliasDecl* decl, Scope* scope) {
  if (decl->is_template) {
    Symbol* symbol =
        scopes_.add_symbol(scope, SymbolKind::kAliasTemplate, decl->name, decl->location);
    symbol->alias = decl;
    symbol->scope = scope;
    return;
  }
  const Type* type = parts_.resolver.resolve_type(decl->type, scope);
  if (Symbol* before = scopes_.find_local(scope, decl->name)) {
    const bool same = before->kind == SymbolKind::kType && same_type(before->type, type);
    if (same || type->is_error()) return;
    // Redeclaring the same type is fine: `typedef struct S { .. } S;`, or an injected name.
    report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    return;
  }
  Symbol* symbol = scopes_.add_symbol(scope, SymbolKind::kType, decl->name, decl->location);
  symbol->type = type;
  symbol->lacks_matrix_order = type->is_matrix() && decl->type->pack_matrix == 0 &&
                               parts_.resolver.lacks_matrix_order(decl->type, scope);
}

void Declarations::declare_using(const QualifiedName& name, Scope* scope, SourceLocation location) {
  Symbol* symbol = parts_.resolver.resolve_name(name, scope, false);
  if (!symbol) return;
  const std::string_view last = name.last().identifier;
  Symbol* before = scopes_.find_local(scope, last);
  if (before && before->kind == SymbolKind::kFunctions && symbol->kind == SymbolKind::kFunctions) {
    before->functions.insert(before->functions.end(), symbol->functions.begin(),
                             symbol->functions.end());
    return;
  }
  if (before && before != symbol) {
    report(CheckId::kRedefinition, location, {std::string(last)});
    return;
  }
  scope->symbols[last] = symbol;
}

}  // namespace kaamos::hlsl
