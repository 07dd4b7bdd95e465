// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/specializations.h"

#include "runtime/hlsl/check/names/name_parts.h"
#include "runtime/hlsl/check/names/signatures.h"

namespace kaamos::hlsl {
namespace {

// Like an instance's body it sees everything that is declared.
constexpr uint32_t kSeesAll = ~0u;

}  // namespace

// ---- Structs

void Specializations::specialize_struct(const StructDecl* decl, Scope* scope) {
  Symbol* symbol = scopes_.find_local(scope, decl->name);
  if (!symbol || symbol->kind != SymbolKind::kStructTemplate) {
    report(CheckId::kSpecializesNothing, decl->location, {std::string(decl->name)});
    return;
  }
  StructTemplate* structure = symbol->struct_template;
  if (decl->is_instantiation) {
    const NamePart part{.location = decl->location,
                        .identifier = decl->name,
                        .has_template_arguments = true,
                        .template_arguments = decl->specialized};
    const StructInfo* info =
        parts_.templates.instantiate_struct(structure, part, decl->location, scope);
    program_.declared_types[decl] = info ? info->type : types_.error();
    return;
  }
  if (decl->is_template) {
    structure->partials.push_back(decl);
    return;
  }
  TemplateValues values;
  const auto parameters = structure->decl->template_parameters;
  if (!parts_.templates.bind_arguments(parameters, decl->specialized, scope, values) ||
      !parts_.templates.complete_arguments(parameters, structure->scope, values)) {
    report(CheckId::kTemplateArguments, decl->location, {structure->name});
    return;
  }
  const std::string suffix = parts_.templates.template_suffix(values);
  StructInfo*& info = structure->instances[suffix];
  if (info && (info->complete || info->decl->is_definition)) {
    report(CheckId::kSpecializedLate, decl->location, {structure->name + suffix});
    return;
  }
  if (!info) info = parts_.structs.make_struct(decl, scope, structure->name + suffix);
  info->decl = decl;
  info->template_name = structure->decl->name;
  program_.instance_arguments[info] = {structure, values};
  program_.declared_types[decl] = info->type;
  if (decl->is_definition) parts_.structs.complete_struct(info);
}

bool Specializations::match_partial(StructTemplate* structure, const StructDecl* partial,
                                    const TemplateValues& values, TemplateValues& found) {
  const auto parameters = partial->template_parameters;
  found.assign(parameters.size(), {});
  for (size_t i = 0; i < partial->specialized.size() && i < values.size(); ++i) {
    const TemplateArgument& pattern = partial->specialized[i];
    if (values[i].type) {
      if (pattern.type && !parts_.templates.deduce(pattern.type, values[i].type, parameters, found))
        return false;
    } else if (pattern.value) {
      parts_.templates.deduce_value(pattern.value, values[i].value->literal[0], parameters, found);
    }
  }
  if (!parts_.templates.complete_arguments(parameters, structure->scope, found)) return false;
  // With these values the pattern must mean what was asked for.
  TemplateValues meant;
  const auto primary = structure->decl->template_parameters;
  Scope* scope = parts_.templates.template_scope(parameters, found, structure->scope);
  return parts_.templates.bind_arguments(primary, partial->specialized, scope, meant) &&
         parts_.templates.complete_arguments(primary, structure->scope, meant) &&
         parts_.templates.template_suffix(meant) == parts_.templates.template_suffix(values);
}

const StructDecl* Specializations::partial_for(StructTemplate* structure,
                                               const TemplateValues& values,
                                               SourceLocation location, TemplateValues& found) {
  const StructDecl* best = nullptr;
  bool is_ambiguous = false;
  for (const StructDecl* partial : structure->partials) {
    TemplateValues own;
    messages_.mute();
    const bool fits = match_partial(structure, partial, values, own);
    messages_.unmute();
    if (!fits) continue;
    // The one with fewer free parameters says more.
    const size_t free_count = partial->template_parameters.size();
    if (best && free_count > best->template_parameters.size()) continue;
    is_ambiguous = best && free_count == best->template_parameters.size();
    best = partial;
    found = own;
  }
  if (is_ambiguous) {
    report(CheckId::kAmbiguousPartial, location,
           {structure->name + parts_.templates.template_suffix(values)});
  }
  return best;
}

// ---- Functions

FunctionInfo* Specializations::same_parameters(Symbol* symbol, const FunctionInfo& function) {
  if (!symbol || symbol->kind != SymbolKind::kFunctions) return nullptr;
  for (FunctionInfo* other : symbol->functions) {
    if (other->is_template != function.is_template ||
        other->decl->parameters.size() != function.decl->parameters.size() ||
        other->is_const_method != function.is_const_method) {
      continue;
    }
    if (function.is_template &&
        other->decl->template_parameters.size() != function.decl->template_parameters.size()) {
      continue;
    }
    // Without resolved parameters their number, which agrees, has to do.
    if (function.parameters.empty() || have_same_parameters(*other, function)) return other;
  }
  return nullptr;
}

// Gives a declared function the body of `decl`, whose names are looked up in `scope`.
void Specializations::define(FunctionInfo* function, const FunctionDecl* decl, Scope* scope) {
  function->definition = decl->body ? decl : nullptr;
  function->scope = scope;
  function->body_sequence = kSeesAll;
  if (function->is_template) {
    function->decl = decl;
    return;
  }
  for (size_t i = 0; i < function->parameters.size(); ++i) {
    function->parameters[i].name = decl->parameters[i]->name;
    function->parameters[i].decl = decl->parameters[i];
  }
}

void Specializations::specialize_function(const FunctionDecl* decl, Scope* scope,
                                          StructInfo* owner) {
  FunctionInfo* wanted = parts_.functions.make_function(decl, scope, owner);
  parts_.functions.resolve_signature(wanted);
  wanted->definition = nullptr;
  if (wanted->signature_failed) return;
  Symbol* symbol = scopes_.find_local(scope, decl->name);
  FunctionInfo* found = nullptr;
  if (symbol && symbol->kind == SymbolKind::kFunctions) {
    std::vector<Value> arguments;
    for (const ParameterInfo& parameter : wanted->parameters) {
      Value& value = arguments.emplace_back();
      value.kind = ValueKind::kExpr;
      value.type = parameter.type;
    }
    for (FunctionInfo* candidate : symbol->functions) {
      if (!candidate->is_template || found) continue;
      if (candidate->decl->parameters.size() != arguments.size()) continue;
      FunctionInfo* instance =
          parts_.templates.instantiate_function(candidate, decl->specialized, scope, arguments);
      if (!instance) continue;
      bool same = same_type(instance->result, wanted->result);
      for (size_t i = 0; i < arguments.size() && same; ++i) {
        const ParameterInfo& a = instance->parameters[i];
        const ParameterInfo& b = wanted->parameters[i];
        same = same_type(a.type, b.type) && a.is_out == b.is_out && a.is_in == b.is_in;
      }
      if (same) found = instance;
    }
    // A member of one instance of a struct template.
    if (!found && owner && decl->specialized.empty()) found = same_parameters(symbol, *wanted);
  }
  if (!found) {
    report(CheckId::kSpecializesNothing, decl->location, {describe(*wanted)});
    return;
  }
  if (decl->is_instantiation) return;
  const bool is_defined = found->definition && found->definition->is_specialization;
  if (found->state != FunctionInfo::State::kPending || is_defined) {
    report(CheckId::kSpecializedLate, decl->location, {describe(*found)});
    return;
  }
  define(found, decl, scope);
}

// ---- Members of struct templates

// The template whose parameters a list before `S<T>::` names; null if S is no template.
StructTemplate* Specializations::outer_template(const QualifiedName& qualifier, Scope* scope) {
  QualifiedName outer = qualifier;
  Symbol* symbol = nullptr;
  if (qualifier.parts.size() == 1) {
    symbol = scopes_.find(scope, qualifier.last().identifier);
  } else {
    outer.parts = qualifier.parts.first(qualifier.parts.size() - 1);
    Symbol* container = parts_.resolver.resolve_name(outer, scope, true);
    Scope* inside =
        container && container->kind == SymbolKind::kNamespace ? container->scope : nullptr;
    symbol = inside ? scopes_.find_local(inside, qualifier.last().identifier) : nullptr;
  }
  const bool is_template = symbol && symbol->kind == SymbolKind::kStructTemplate &&
                           qualifier.last().has_template_arguments;
  return is_template ? symbol->struct_template : nullptr;
}

void Specializations::declare_outer(StructTemplate* structure, const OuterMember& member) {
  const SourceLocation location =
      member.function ? member.function->location : member.variable->location;
  if (member.parameters.size() != structure->decl->template_parameters.size()) {
    report(CheckId::kTemplateArguments, location, {structure->name});
    return;
  }
  const std::string_view name = member.function ? member.function->name : member.variable->name;
  bool is_declared = false;
  for (const Decl* inner : structure->decl->members) is_declared |= inner->name == name;
  if (!is_declared) {
    report(CheckId::kNoSuchMethod, location, {structure->name, std::string(name)});
    return;
  }
  structure->members.push_back(member);
  for (const auto& [suffix, info] : structure->instances) {
    if (info->complete && info->decl == structure->decl) {
      apply_outer(info, program_.instance_arguments[info].second, member);
    }
  }
}

void Specializations::apply_outer(StructInfo* info, const TemplateValues& values,
                                  const OuterMember& member) {
  Scope* scope = parts_.templates.template_scope(member.parameters, values, info->scope);
  if (member.variable) {
    Symbol* symbol = scopes_.find_local(info->scope, member.variable->name);
    if (symbol && symbol->kind == SymbolKind::kVariable) {
      define_static(symbol->variable, member.variable, scope);
    }
    return;
  }
  FunctionInfo* function = parts_.functions.make_function(member.function, scope, info);
  function->definition = nullptr;
  // With one list it is the struct's, and the function is none.
  function->is_template = !member.function->outer_parameters.empty();
  if (!function->is_template) parts_.functions.resolve_signature(function);
  if (function->signature_failed) return;
  FunctionInfo* declared =
      same_parameters(scopes_.find_local(info->scope, member.function->name), *function);
  if (!declared) {
    report(CheckId::kNoSuchMethod, member.function->location,
           {info->name, std::string(member.function->name)});
    return;
  }
  if (declared->definition && declared->definition->is_specialization) return;
  if (declared->definition && declared->definition != member.function) {
    report(CheckId::kFunctionRedefined, member.function->location, {describe(*declared)});
    return;
  }
  define(declared, member.function, scope);
}

// ---- Static members

void Specializations::define_static(VariableInfo* variable, const VariableDecl* decl,
                                    Scope* scope) {
  if (variable->type->is_error()) return;
  const Type* type = parts_.resolver.resolve_type(decl->type, scope);
  if (type->is_error()) return;
  // `const int S::x;` after `static const int x = 3;` in the struct.
  const bool is_defined_inside = variable->decl->initializer && !decl->initializer;
  if (is_defined_inside && same_type(type, variable->type)) return;
  const bool is_repeated = variable->decl->initializer || variable->decl->qualifier;
  if (variable->kind != VariableKind::kGlobal || is_repeated || !same_type(type, variable->type)) {
    report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    return;
  }
  if (variable->state != VariableInfo::State::kPending) {
    report(CheckId::kSpecializedLate, decl->location, {std::string(decl->name)});
    return;
  }
  variable->decl = decl;
  variable->scope = scope;
  variable->sequence = ~0u;
}

void Specializations::declare_outer_static(const VariableDecl* decl, Scope* scope) {
  if (!decl->template_parameters.empty()) {
    if (StructTemplate* structure = outer_template(*decl->qualifier, scope)) {
      declare_outer(structure, {nullptr, decl, decl->template_parameters});
      return;
    }
  }
  Symbol* owner = parts_.resolver.resolve_name(*decl->qualifier, scope, false);
  if (!owner) return;
  Scope* inside = parts_.resolver.scope_of_part(decl->qualifier->last(), owner, scope);
  Symbol* member = inside && inside->structure ? scopes_.find_local(inside, decl->name) : nullptr;
  if (!member || member->kind != SymbolKind::kVariable) {
    report(CheckId::kNoSuchStatic, decl->location,
           {Scopes::spell(*decl->qualifier), std::string(decl->name)});
    return;
  }
  define_static(member->variable, decl, inside);
}

}  // namespace kaamos::hlsl
