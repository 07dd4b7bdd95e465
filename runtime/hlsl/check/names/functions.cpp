// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/functions.h"

#include "runtime/hlsl/check/names/name_parts.h"
#include "runtime/hlsl/check/names/signatures.h"

namespace kaamos::hlsl {

FunctionInfo* Functions::make_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner) {
  FunctionInfo* function = &program_.functions.emplace_back();
  function->name = decl->name;
  function->decl = decl;
  function->definition = decl->body ? decl : nullptr;
  function->scope = scope;
  function->owner = owner;
  function->is_static = (decl->modifiers & kModStatic) != 0;
  function->is_exported = (decl->modifiers & kModExport) != 0;
  function->is_const_method = decl->is_const_method;
  function->is_template = decl->is_template;
  function->qualified = Scopes::qualify(scope, decl->name);
  return function;
}

void Functions::resolve_signature(FunctionInfo* function) {
  const FunctionDecl* decl = function->decl;
  function->result = parts_.resolver.resolve_type(decl->return_type, function->scope);
  if (function->result->is_error()) function->signature_failed = true;
  if (function->result->is_query() && function->is_exported) {
    report(CheckId::kRayQueryPlace, decl->location,
           {to_string(function->result), "what an exported function returns"});
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
    if (parts_.resolver.is_of_other_stage(parameter->type, function->scope)) {
      function->other_stage = parameter->type;
      function->signature_failed = true;
      info.type = types_.error();
      info.decl = parameter;
      continue;
    }
    info.type = parts_.resolver.resolve_type(parameter->type, function->scope);
    info.is_out = (parameter->modifiers & kModOut) != 0;
    info.is_in = !info.is_out || (parameter->modifiers & kModIn) != 0;
    info.is_const = is_const_type(parameter->type);
    info.decl = parameter;
    info.default_value = parameter->default_value;
    // A method may take its own struct, which is complete by the time its body is lowered.
    const bool is_own = function->owner && info.type->is_struct();
    if (!is_own &&
        !parts_.variables.check_variable_type(info.type, parameter->location, parameter->name)) {
      info.type = types_.error();
      function->signature_failed = true;
    } else if (info.is_unbounded() && !info.is_unsized() &&
               (info.is_out || !info.type->element->is_resource())) {
      report(CheckId::kUnboundedVariable, parameter->location, {std::string(parameter->name)});
      info.type = types_.error();
      function->signature_failed = true;
    }
  }
}

FunctionInfo* Functions::same_signature(Symbol* symbol, const FunctionInfo& function) {
  for (FunctionInfo* other : symbol->functions) {
    if (other->is_template || other->scope != function.scope) continue;
    if (have_same_parameters(*other, function)) return other;
  }
  return nullptr;
}

bool Functions::join_template(Symbol* symbol, const FunctionInfo& function) {
  for (FunctionInfo* other : symbol->functions) {
    if (!other->is_template || other->scope != function.scope || other->announced ||
        (other->definition && function.definition) ||
        !are_written_alike(*other->decl, *function.decl)) {
      continue;
    }
    if (function.definition) {
      other->announced = other->decl;
      other->decl = other->definition = function.definition;
    }
    return true;
  }
  return false;
}

void Functions::declare_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner) {
  if (decl->qualifier) {
    if (decl->is_template) {
      if (StructTemplate* structure =
              parts_.specializations.outer_template(*decl->qualifier, scope)) {
        const bool is_nested = !decl->outer_parameters.empty();
        parts_.specializations.declare_outer(
            structure,
            {decl, nullptr, is_nested ? decl->outer_parameters : decl->template_parameters});
        return;
      }
    }
    Symbol* symbol = parts_.resolver.resolve_name(*decl->qualifier, scope, false);
    if (!symbol) return;
    Scope* inside = parts_.resolver.scope_of_part(decl->qualifier->last(), symbol, scope);
    if (!inside) {
      report(CheckId::kNotAScope, decl->location, {Scopes::spell(*decl->qualifier)});
      return;
    }
    scope = inside;
    owner = inside->structure;
  }
  if (decl->is_specialization)
    return parts_.specializations.specialize_function(decl, scope, owner);
  FunctionInfo* function = make_function(decl, scope, owner);
  if (owner && decl->qualifier) function->is_static = false;
  Symbol* symbol =
      owner ? scopes_.find_local(scope, decl->name) : scopes_.find_taken(scope, decl->name);
  if (symbol && symbol->kind != SymbolKind::kFunctions) {
    report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    function->signature_failed = true;
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
      report(CheckId::kReturnTypeDiffers, decl->location, {describe(*before)});
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
                         "half is float16_t with -enable-16bit-types, so both parameters are '" +
                             to_string(function->parameters[i].type) + "'"});
      }
      messages_.report_with_notes(CheckId::kFunctionRedefined, decl->location, {describe(*before)},
                                  notes);
      return;
    }
    if (decl->body) {
      before->definition = decl;
      before->body_sequence = scopes_.next_sequence();
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
    FunctionInfo* pattern = symbol && function->is_template
                                ? parts_.specializations.same_parameters(symbol, *function)
                                : nullptr;
    if (pattern && decl->body) return parts_.specializations.define(pattern, decl, scope);
    report(CheckId::kNoSuchMethod, decl->location, {owner->name, std::string(decl->name)});
    return;
  }
  if (symbol && function->is_template && join_template(symbol, *function)) return;
  if (!symbol)
    symbol = scopes_.add_symbol(scope, SymbolKind::kFunctions, decl->name, decl->location);
  symbol->functions.push_back(function);
  const bool ordered = scope->kind == ScopeKind::kGlobal || scope->kind == ScopeKind::kNamespace;
  function->sequence = ordered ? scopes_.next_sequence() : 0;
  function->body_sequence = ordered ? function->sequence : ~0u;
  if (!function->is_template) program_.all_functions.push_back(function);
}

}  // namespace kaamos::hlsl
