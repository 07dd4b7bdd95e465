// SPDX-License-Identifier: MIT
// Globals, namespaces, aliases, functions.
#include <algorithm>

#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {

void Checker::declare_builtins() {
  const auto make = [&](std::string_view name,
                        std::initializer_list<std::pair<std::string_view, const Type*>> fields) {
    StructInfo* info = make_struct(nullptr, global_, std::string(name));
    for (const auto& [field_name, type] : fields) {
      FieldInfo& field = info->fields.emplace_back();
      field.name = field_name;
      field.type = type;
      field.index = static_cast<uint32_t>(info->ir->fields.size());
      ir::Field& ir_field = info->ir->fields.emplace_back();
      ir_field.name = field_name;
      ir_field.type = type->ir;
      Symbol* symbol = add_symbol(info->scope, SymbolKind::kField, field_name, {});
      symbol->field = field.index;
    }
    info->complete = true;
    Symbol* symbol = add_symbol(global_, SymbolKind::kType, name, {});
    symbol->type = info->type;
    symbol->scope = info->scope;
    return info;
  };
  const Type* scalar = types_.scalar(Scalar::kFloat32);
  const Type* vector = types_.vector(Scalar::kFloat32, 3);
  ray_desc_ = make("RayDesc",
                   {{"Origin", vector}, {"TMin", scalar}, {"Direction", vector}, {"TMax", scalar}});
  module_->ray_desc = ray_desc_->ir;
  triangle_attributes_ = make("BuiltInTriangleIntersectionAttributes",
                              {{"barycentrics", types_.vector(Scalar::kFloat32, 2)}});
  const Type* flags = types_.scalar(Scalar::kUint32);
  for (size_t i = 0; i < kBuiltinConstantCount; ++i) {
    Symbol* symbol = add_symbol(global_, SymbolKind::kConstant, kBuiltinConstants[i].name, {});
    symbol->type = flags;
    symbol->value = build_.uint32(kBuiltinConstants[i].value);
  }
  for (const std::string_view name :
       {"RAY_FLAG", "RAYQUERY_FLAG", "CANDIDATE_TYPE", "COMMITTED_STATUS"}) {
    add_symbol(global_, SymbolKind::kType, name, {})->type = flags;
  }
}

void Checker::declare_all(std::span<const Decl* const> declarations, Scope* scope) {
  for (const Decl* declaration : declarations) declare(declaration, scope);
}

void Checker::declare(const Decl* declaration, Scope* scope) {
  if (lower_.depth_ > 100) return;
  ++lower_.depth_;
  switch (declaration->kind) {
    case DeclKind::kVariable:
      declare_variable(static_cast<const VariableDecl*>(declaration), scope);
      break;
    case DeclKind::kFunction:
      declare_function(static_cast<const FunctionDecl*>(declaration), scope, nullptr);
      break;
    case DeclKind::kStruct:
      declare_struct(static_cast<const StructDecl*>(declaration), scope);
      break;
    case DeclKind::kEnum:
      declare_enum(static_cast<const EnumDecl*>(declaration), scope);
      break;
    case DeclKind::kBuffer:
      declare_buffer(static_cast<const BufferDecl*>(declaration), scope);
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
      Symbol* symbol = resolve_name(*decl->target, scope, is_dx);
      if (symbol && symbol->kind != SymbolKind::kNamespace) {
        report(CheckId::kNotANamespace, decl->location, {spell(*decl->target)});
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
      declare_subobject(static_cast<const SubobjectDecl*>(declaration));
      break;
    case DeclKind::kParameter:
      break;
  }
  --lower_.depth_;
}

void Checker::declare_namespace(const NamespaceDecl* decl, Scope* scope) {
  Symbol* symbol = decl->name.empty() ? nullptr : find_local(scope, decl->name);
  if (symbol && symbol->kind != SymbolKind::kNamespace) {
    report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    return;
  }
  if (!symbol) {
    Scope* inner = make_scope(ScopeKind::kNamespace, scope, decl->name);
    if (decl->name.empty()) {
      scope->used.push_back(inner);
      declare_all(decl->declarations, inner);
      return;
    }
    symbol = add_symbol(scope, SymbolKind::kNamespace, decl->name, decl->location);
    symbol->scope = inner;
  }
  declare_all(decl->declarations, symbol->scope);
}

void Checker::declare_alias(const TypeAliasDecl* decl, Scope* scope) {
  if (decl->is_template) {
    Symbol* symbol = add_symbol(scope, SymbolKind::kAliasTemplate, decl->name, decl->location);
    symbol->alias = decl;
    symbol->scope = scope;
    return;
  }
  const Type* type = resolve_type(decl->type, scope);
  if (Symbol* before = find_local(scope, decl->name)) {
    const bool same = before->kind == SymbolKind::kType && same_type(before->type, type);
    if (same || type->is_error()) return;
    // Redeclaring the same type is fine: `typedef struct S { .. } S;`, or an injected name.
    report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    return;
  }
  Symbol* symbol = add_symbol(scope, SymbolKind::kType, decl->name, decl->location);
  symbol->type = type;
}

void Checker::declare_using(const QualifiedName& name, Scope* scope, SourceLocation location) {
  Symbol* symbol = resolve_name(name, scope, false);
  if (!symbol) return;
  const std::string_view last = name.last().identifier;
  Symbol* before = find_local(scope, last);
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

bool Checker::check_variable_type(const Type* type, SourceLocation location,
                                  std::string_view name) {
  if (type->is_error()) return false;
  if (type->is_void()) {
    report(CheckId::kVoidVariable, location, {"'" + std::string(name) + "' of type void"});
    return false;
  }
  const Type* element = type;
  while (element->is_array()) element = element->element;
  if (element->kind == TypeKind::kString) {
    report(CheckId::kStringUse, location);
    return false;
  }
  if (element->is_query() && type->is_array()) {
    report(CheckId::kRayQueryPlace, location, {to_string(element), "an element of an array"});
    return false;
  }
  const StructDecl* decl = element->is_struct() ? element->structure->decl : nullptr;
  if (decl && decl->is_interface) {
    report(CheckId::kInterfaceObject, location, {to_string(element)});
    return false;
  }
  if (element->is_struct() && !element->structure->complete) {
    report(CheckId::kIncomplete, location, {to_string(element)});
    return false;
  }
  return true;
}

void Checker::declare_variable(const VariableDecl* decl, Scope* scope) {
  if (decl->qualifier) return declare_outer_static(decl, scope);
  const Type* type = resolve_variable_type(decl, scope);
  if (!check_variable_type(type, decl->location, decl->name)) {
    // A symbol of unknown type prevents follow-up errors where the name is used.
    if (!find_local(scope, decl->name)) {
      VariableInfo* info = &variables_.emplace_back();
      info->name = decl->name;
      info->type = types_.error();
      add_symbol(scope, SymbolKind::kVariable, decl->name, decl->location)->variable = info;
    }
    return;
  }
  if (find_taken(scope, decl->name)) {
    report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    return;
  }
  if (type->is_query()) {
    report(CheckId::kRayQueryPlace, decl->location, {to_string(type), "a global variable"});
    return;
  }
  const bool is_static = (decl->modifiers & (kModStatic | kModGroupshared)) != 0;
  const Type* element = type;
  while (element->is_array()) element = element->element;
  if (!is_static && element->is_resource()) {
    declare_binding(decl, type, scope);
    return;
  }
  const bool is_const = is_const_type(decl->type);
  if (is_static || (is_const && decl->initializer)) {
    if (!is_static) report(CheckId::kConstWithoutStatic, decl->location, {std::string(decl->name)});
    declare_static(decl, type, scope);
    return;
  }
  declare_uniform(decl, type, scope);
}

void Checker::declare_static(const VariableDecl* decl, const Type* type, Scope* scope) {
  VariableInfo* info = &variables_.emplace_back();
  info->kind = VariableKind::kGlobal;
  info->name = decl->name;
  info->is_const = is_const_type(decl->type);
  info->decl = decl;
  info->scope = scope;
  info->state = VariableInfo::State::kPending;
  if (type->is_array() && type->count == 0) {
    const auto* list = as<InitListExpr>(decl->initializer);
    if (!list) {
      report(CheckId::kUnboundedVariable, decl->location, {std::string(decl->name)});
      type = types_.error();
    } else {
      ir::Block ignored;
      Lowerer::BodyScope body(lower_, lower_.function_, &ignored, scope);
      std::vector<Lowerer::Piece> pieces;
      lower_.collect_pieces(list, pieces, 0);
      uint64_t count = 0;
      for (const Lowerer::Piece& piece : pieces) count += flat_component_count(piece.type);
      const uint64_t element = std::max<uint64_t>(1, flat_component_count(type->element));
      type = types_.array(type->element, static_cast<uint32_t>(std::max<uint64_t>(
                                             1, std::min<uint64_t>(count / element, 1u << 20))));
    }
  }
  info->type = type;
  at(decl->location);
  const bool shared = (decl->modifiers & kModGroupshared) != 0;
  info->variable = build_.variable(qualify(scope, decl->name), type->ir,
                                   shared ? ir::Storage::kGroupShared : ir::Storage::kStaticGlobal);
  Symbol* symbol = add_symbol(scope, SymbolKind::kVariable, decl->name, decl->location);
  symbol->variable = info;
  info->sequence = symbol->sequence ? symbol->sequence : visible_;
  if (type->is_error()) {
    info->state = VariableInfo::State::kDone;
  } else if (shared) {
    info->state = VariableInfo::State::kDone;
    if (decl->initializer) {
      report(CheckId::kGroupsharedInitialiser, decl->location, {std::string(decl->name)});
    }
    if (contains_resource(type)) {
      report(CheckId::kUnsupported, decl->location, {"groupshared memory that holds resources"});
    }
  }
}

void Checker::initialise(VariableInfo* variable) {
  if (variable->state == VariableInfo::State::kDone) return;
  if (variable->state == VariableInfo::State::kRunning) {
    report(CheckId::kSelfInitialised, variable->decl->location, {std::string(variable->name)});
    return;
  }
  variable->state = VariableInfo::State::kRunning;
  if (!variable->decl->initializer) {
    if (variable->is_const) {
      report(CheckId::kConstWithoutValue, variable->decl->location, {std::string(variable->name)});
    }
    variable->state = VariableInfo::State::kDone;
    return;
  }
  variable->initialiser_info = std::make_unique<FunctionInfo>();
  variable->initialiser = variable->initialiser_info.get();
  {
    Lowerer::BodyScope body(lower_, variable->initialiser_info.get(), &variable->start_up,
                            variable->scope);
    visible_ = variable->sequence;
    at(variable->decl->location);
    const ir::Expr* value = lower_.initial_value(variable->decl->initializer, variable->type);
    if (value && !variable->start_up.empty()) {
      lower_.assign(variable->variable, value);
    } else if (value) {
      variable->variable->initialiser = value;
      if (variable->is_const && is_constant(value)) {
        variable->variable->storage = ir::Storage::kConstant;
      }
    }
  }
  check_initialiser_imports(*variable);
  variable->state = VariableInfo::State::kDone;
}

void Checker::check_initialisers() {
  // By index, because an initialiser may declare more variables (static locals).
  for (size_t i = 0; i < variables_.size(); ++i) {
    if (variables_[i].kind == VariableKind::kGlobal) initialise(&variables_[i]);
  }
}

FunctionInfo* Checker::make_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner) {
  FunctionInfo* function = &functions_.emplace_back();
  function->name = decl->name;
  function->decl = decl;
  function->definition = decl->body ? decl : nullptr;
  function->scope = scope;
  function->owner = owner;
  function->is_static = (decl->modifiers & kModStatic) != 0;
  function->is_exported = (decl->modifiers & kModExport) != 0;
  function->is_const_method = decl->is_const_method;
  function->is_template = decl->is_template;
  function->qualified = qualify(scope, decl->name);
  return function;
}

void Checker::resolve_signature(FunctionInfo* function) {
  const FunctionDecl* decl = function->decl;
  function->result = resolve_type(decl->return_type, function->scope);
  if (function->result->is_error()) function->signature_failed = true;
  if (function->result->is_query()) {
    report(CheckId::kRayQueryPlace, decl->location,
           {to_string(function->result), "what a function returns"});
    function->result = types_.error();
    function->signature_failed = true;
  }
  if (function->result->kind == TypeKind::kString) {
    report(CheckId::kStringUse, decl->location);
    function->signature_failed = true;
  }
  const Type* element = function->result;
  while (element->is_array() && element->count != 0) element = element->element;
  if (element->is_array() || (function->result->is_array() && contains_resource(element))) {
    report(CheckId::kReturnsArray, decl->location, {std::string(decl->name)});
    function->signature_failed = true;
  }
  function->parameters.clear();
  for (const ParameterDecl* parameter : decl->parameters) {
    ParameterInfo& info = function->parameters.emplace_back();
    info.name = parameter->name;
    info.type = resolve_type(parameter->type, function->scope);
    info.is_out = (parameter->modifiers & kModOut) != 0;
    info.is_in = !info.is_out || (parameter->modifiers & kModIn) != 0;
    info.is_const = is_const_type(parameter->type);
    info.decl = parameter;
    info.default_value = parameter->default_value;
    // A method may take its own struct, which is complete by the time its body is lowered.
    const bool is_own = function->owner && info.type->is_struct();
    if (!is_own && !check_variable_type(info.type, parameter->location, parameter->name)) {
      info.type = types_.error();
      function->signature_failed = true;
    } else if (info.is_unbounded() && (info.is_out || !info.type->element->is_resource())) {
      report(CheckId::kUnboundedVariable, parameter->location, {std::string(parameter->name)});
      info.type = types_.error();
      function->signature_failed = true;
    }
    if (info.default_value && info.is_out) {
      report(CheckId::kDefaultOfOut, parameter->location, {std::string(parameter->name)});
    }
  }
}

bool have_same_parameters(const FunctionInfo& one, const FunctionInfo& other) {
  return std::equal(one.parameters.begin(), one.parameters.end(), other.parameters.begin(),
                    other.parameters.end(), [](const ParameterInfo& a, const ParameterInfo& b) {
                      return same_type(a.type, b.type) && a.is_out == b.is_out &&
                             a.is_in == b.is_in;
                    });
}

FunctionInfo* Checker::same_signature(Symbol* symbol, const FunctionInfo& function) {
  for (FunctionInfo* other : symbol->functions) {
    if (other->is_template || other->scope != function.scope) continue;
    if (have_same_parameters(*other, function)) return other;
  }
  return nullptr;
}

void Checker::declare_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner) {
  if (decl->qualifier) {
    if (decl->is_template) {
      if (StructTemplate* structure = outer_template(*decl->qualifier, scope)) {
        const bool is_nested = !decl->outer_parameters.empty();
        declare_outer(structure, {decl, nullptr,
                                  is_nested ? decl->outer_parameters : decl->template_parameters});
        return;
      }
    }
    Symbol* symbol = resolve_name(*decl->qualifier, scope, false);
    if (!symbol) return;
    Scope* inside = scope_of_part(decl->qualifier->last(), symbol, scope);
    if (!inside) {
      report(CheckId::kNotAScope, decl->location, {spell(*decl->qualifier)});
      return;
    }
    scope = inside;
    owner = inside->structure;
  }
  if (decl->is_specialization) return specialize_function(decl, scope, owner);
  FunctionInfo* function = make_function(decl, scope, owner);
  if (owner && decl->qualifier) function->is_static = false;
  Symbol* symbol = owner ? find_local(scope, decl->name) : find_taken(scope, decl->name);
  if (symbol && symbol->kind != SymbolKind::kFunctions) {
    report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    return;
  }
  if (!function->is_template) {
    resolve_signature(function);
    if (function->signature_failed) function->is_exported = false;
  }
  FunctionInfo* before =
      symbol && !function->is_template ? same_signature(symbol, *function) : nullptr;
  if (before) {
    if (!same_type(before->result, function->result) && !function->signature_failed) {
      report(CheckId::kReturnTypeDiffers, decl->location, {lower_.describe(*before)});
      return;
    }
    if (before->definition && decl->body) {
      std::vector<std::pair<SourceLocation, std::string>> notes = {
          {before->definition->location, "defined here"}};
      for (size_t i = 0; i < decl->parameters.size(); ++i) {
        const TypeSyntax* a = before->definition->parameters[i]->type;
        const TypeSyntax* b = decl->parameters[i]->type;
        const bool is_other_word =
            a->kind == TypeSyntaxKind::kNumeric && b->kind == a->kind && a->scalar != b->scalar;
        if (!is_other_word) continue;
        notes.push_back({decl->parameters[i]->location,
                         "half and the min types are 16-bit types with -enable-16bit-types, so "
                         "both parameters are '" +
                             to_string(function->parameters[i].type) + "'"});
      }
      report_with_notes(CheckId::kFunctionRedefined, decl->location, {lower_.describe(*before)},
                        notes);
      return;
    }
    if (decl->body) {
      before->definition = decl;
      before->body_sequence = ++sequence_;
      // Attributes such as [shader("miss")] may be on either declaration.
      if (!decl->attributes.empty()) before->decl = decl;
      for (size_t i = 0; i < function->parameters.size(); ++i) {
        before->parameters[i].name = function->parameters[i].name;
        before->parameters[i].decl = function->parameters[i].decl;
        if (function->parameters[i].default_value) {
          before->parameters[i].default_value = function->parameters[i].default_value;
        }
      }
    }
    before->is_exported = before->is_exported || function->is_exported;
    function->definition = nullptr;  // it lives on in the earlier one
    return;
  }
  if (decl->qualifier && owner) {
    FunctionInfo* pattern =
        symbol && function->is_template ? same_parameters(symbol, *function) : nullptr;
    if (pattern && decl->body) return define(pattern, decl, scope);
    report(CheckId::kNoSuchMethod, decl->location, {owner->name, std::string(decl->name)});
    return;
  }
  if (!symbol) symbol = add_symbol(scope, SymbolKind::kFunctions, decl->name, decl->location);
  symbol->functions.push_back(function);
  const bool ordered = scope->kind == ScopeKind::kGlobal || scope->kind == ScopeKind::kNamespace;
  function->sequence = ordered ? ++sequence_ : 0;
  function->body_sequence = ordered ? function->sequence : ~0u;
  if (!function->is_template) all_functions_.push_back(function);
}

}  // namespace kaamos::hlsl
