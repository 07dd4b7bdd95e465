// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/variables.h"

#include "runtime/hlsl/check/names/name_parts.h"

namespace kaamos::hlsl {

bool Variables::check_variable_type(const Type* type, SourceLocation location,
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

void Variables::declare_variable(const VariableDecl* decl, Scope* scope) {
  if (decl->qualifier) return parts_.specializations.declare_outer_static(decl, scope);
  const Type* type = parts_.resolver.resolve_variable_type(decl, scope);
  if (!check_variable_type(type, decl->location, decl->name)) {
    // A symbol of unknown type prevents follow-up errors where the name is used.
    if (!scopes_.find_local(scope, decl->name)) {
      VariableInfo* info = &program_.variables.emplace_back();
      info->name = decl->name;
      info->type = types_.error();
      scopes_.add_symbol(scope, SymbolKind::kVariable, decl->name, decl->location)->variable = info;
    }
    return;
  }
  if (scopes_.find_taken(scope, decl->name)) {
    report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    return;
  }
  if (decl->annotations.pack_offset) {
    report(CheckId::kPackOffsetPlace, decl->annotations.pack_offset->location,
           {std::string(decl->name)});
  }
  if (type->is_query()) {
    report(CheckId::kRayQueryPlace, decl->location, {to_string(type), "a global variable"});
    return;
  }
  const bool is_static = (decl->modifiers & (kModStatic | kModGroupshared)) != 0;
  const Type* element = type;
  while (element->is_array()) element = element->element;
  if (!is_static && element->is_resource()) {
    parts_.bindings.declare_binding(decl, type, scope);
    return;
  }
  const bool is_const = is_const_type(decl->type);
  if (is_static || (is_const && decl->initializer)) {
    if (!is_static) report(CheckId::kConstWithoutStatic, decl->location, {std::string(decl->name)});
    declare_static(decl, type, scope);
    return;
  }
  parts_.bindings.declare_uniform(decl, type, scope);
}

void Variables::declare_static(const VariableDecl* decl, const Type* type, Scope* scope) {
  VariableInfo* info = &program_.variables.emplace_back();
  info->kind = VariableKind::kGlobal;
  info->name = decl->name;
  info->is_const = is_const_type(decl->type);
  info->decl = decl;
  info->scope = scope;
  info->state = VariableInfo::State::kPending;
  if (type->is_array() && type->count == 0) {
    const auto* list = as<InitListExpr>(decl->initializer);
    const Type* whole = decl->initializer && !list
                            ? parts_.evaluator.value_of(decl->initializer, scope).type
                            : nullptr;
    if (!list && !(whole && whole->is_array() && whole->count != 0)) {
      report(CheckId::kUnboundedVariable, decl->location, {std::string(decl->name)});
      type = types_.error();
    } else {
      const uint64_t count =
          list ? parts_.evaluator.component_count(list, scope) : flat_component_count(whole);
      const uint64_t element = std::max<uint64_t>(1, flat_component_count(type->element));
      type = types_.array(type->element, static_cast<uint32_t>(std::max<uint64_t>(
                                             1, std::min<uint64_t>(count / element, 1u << 20))));
    }
  }
  info->type = type;
  at(decl->location);
  const bool shared = (decl->modifiers & kModGroupshared) != 0;
  info->variable = build_.variable(Scopes::qualify(scope, decl->name), type->ir,
                                   shared ? ir::Storage::kGroupShared : ir::Storage::kStaticGlobal);
  Symbol* symbol = scopes_.add_symbol(scope, SymbolKind::kVariable, decl->name, decl->location);
  symbol->variable = info;
  info->sequence = symbol->sequence ? symbol->sequence : scopes_.visible;
  if (contains_hit_object(type)) {
    report(CheckId::kHitObjectPlace, decl->location,
           {shared ? "groupshared memory" : "a static variable"});
  }
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

}  // namespace kaamos::hlsl
