// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/templates.h"

#include "kaamos/shader/query_permissions.h"
#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/names/name_parts.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {
namespace {

constexpr int kMaxTemplateDepth = 64;

std::optional<size_t> parameter_named(std::span<const TemplateParameter> parameters,
                                      const QualifiedName* name) {
  if (!name || !name->is_simple() || name->last().has_template_arguments) return std::nullopt;
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == name->last().identifier) return i;
  }
  return std::nullopt;
}

}  // namespace

bool Templates::bind_arguments(std::span<const TemplateParameter> parameters,
                               std::span<const TemplateArgument> written, Scope* use_scope,
                               TemplateValues& values) {
  values.resize(parameters.size());
  if (written.size() > parameters.size()) return false;
  for (size_t i = 0; i < written.size(); ++i) {
    if (!parameters[i].value_type) {
      values[i].type = parts_.resolver.type_argument(written[i], use_scope);
      if (values[i].type->is_error()) return false;
      continue;
    }
    const auto value =
        parts_.resolver.value_argument(written[i], use_scope, &values[i].written_type);
    if (!value) return false;
    values[i].value =
        build_.literal(types_.scalar(Scalar::kInt64)->ir, {static_cast<uint64_t>(*value)});
  }
  return true;
}

bool Templates::complete_arguments(std::span<const TemplateParameter> parameters, Scope* scope,
                                   TemplateValues& values) {
  for (size_t i = 0; i < parameters.size(); ++i) {
    const TemplateParameter& parameter = parameters[i];
    Scope* known = template_scope(parameters, values, scope);
    if (!values[i].is_set() && parameter.default_type) {
      values[i].type = parts_.resolver.resolve_type(parameter.default_type, known);
    } else if (!values[i].is_set() && parameter.default_value) {
      const auto value = parts_.evaluator.constant_integer(
          parameter.default_value, known, "a template argument", &values[i].written_type);
      if (!value) return false;
      values[i].value =
          build_.literal(types_.scalar(Scalar::kInt64)->ir, {static_cast<uint64_t>(*value)});
    }
    if (!values[i].is_set() || (values[i].type && values[i].type->is_error())) return false;
    if (parameter.value_type && !values[i].value_type) {
      const Type* type = parts_.resolver.resolve_type(parameter.value_type, known);
      if (!(type->is_scalar() || type->is_enum())) return false;
      // A number does not become an enum by itself.
      const Type* written = values[i].written_type;
      if (type->is_enum() && written && !same_type(type, written)) return false;
      values[i].value_type = type;
      values[i].value =
          build_.literal(type->ir, {convert_bits(values[i].value->literal[0],
                                                 values[i].value->type->scalar, type->ir->scalar)});
    }
  }
  return true;
}

Scope* Templates::template_scope(std::span<const TemplateParameter> parameters,
                                 const TemplateValues& values, Scope* parent) {
  Scope* scope = scopes_.make_scope(ScopeKind::kTemplate, parent);
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name.empty() || !values[i].is_set()) continue;
    if (values[i].type) {
      Symbol* symbol = scopes_.add_symbol(scope, SymbolKind::kType, parameters[i].name, {});
      symbol->type = values[i].type;
    } else {
      Symbol* symbol = scopes_.add_symbol(scope, SymbolKind::kConstant, parameters[i].name, {});
      symbol->type = values[i].value_type ? values[i].value_type : types_.scalar(Scalar::kInt64);
      symbol->value = values[i].value;
    }
  }
  return scope;
}

std::string Templates::template_suffix(const TemplateValues& values) {
  std::string text = "<";
  for (const TemplateValue& value : values) {
    if (text.size() > 1) text += ", ";
    text += value.type ? to_string(value.type)
                       : std::to_string(static_cast<int64_t>(value.value->literal[0]));
  }
  return text + ">";
}

// Inside Pair<float>, `Pair` alone means that instance, and `Pair<int>` another.
StructTemplate* Templates::template_of(const Symbol* symbol, const NamePart& part) {
  if (symbol->kind == SymbolKind::kStructTemplate) return symbol->struct_template;
  if (symbol->kind != SymbolKind::kType || !part.has_template_arguments ||
      !symbol->type->is_struct() || symbol->type->structure->template_name != part.identifier) {
    return nullptr;
  }
  const auto found = program_.instance_arguments.find(symbol->type->structure);
  return found == program_.instance_arguments.end() ? nullptr : found->second.first;
}

StructInfo* Templates::instantiate_struct(StructTemplate* structure, const NamePart& part,
                                          SourceLocation location, Scope* scope) {
  const StructDecl* decl = structure->decl;
  TemplateValues values;
  if (!bind_arguments(decl->template_parameters, part.template_arguments, scope, values) ||
      !complete_arguments(decl->template_parameters, structure->scope, values)) {
    report(CheckId::kTemplateArguments, location, {structure->name});
    return nullptr;
  }
  const std::string suffix = template_suffix(values);
  if (auto found = structure->instances.find(suffix); found != structure->instances.end()) {
    return found->second;
  }
  TemplateValues own = values;
  if (const StructDecl* partial =
          parts_.specializations.partial_for(structure, values, location, own))
    decl = partial;
  if (!decl->is_definition) {
    report(CheckId::kIncomplete, location, {structure->name});
    return nullptr;
  }
  // If each level's arguments use the previous ones twice, the name doubles in length at each level
  // and hits its limit long before the depth does.
  constexpr size_t kMaxSuffixBytes = 4096;
  constexpr size_t kMaxInstances = 1024;  // per template, because levels may branch too
  if (template_depth_ >= kMaxTemplateDepth || suffix.size() > kMaxSuffixBytes ||
      structure->instances.size() >= kMaxInstances) {
    report(CheckId::kTemplateDepth, location,
           {structure->name, std::to_string(std::min(template_depth_, kMaxTemplateDepth))});
    return nullptr;
  }
  ++template_depth_;
  Scope* inner = template_scope(decl->template_parameters, own, structure->scope);
  StructInfo* info = parts_.structs.make_struct(decl, inner, structure->name + suffix);
  info->template_name = decl->name;
  structure->instances[suffix] = info;
  program_.instance_arguments[info] = {structure, values};
  const uint32_t visible = scopes_.visible;
  scopes_.visible = ~0u;
  parts_.structs.complete_struct(info);
  if (decl == structure->decl) {
    for (const OuterMember& member : structure->members)
      parts_.specializations.apply_outer(info, values, member);
  }
  scopes_.visible = visible;
  --template_depth_;
  return info;
}

const Type* Templates::instantiate_alias(const TypeAliasDecl* alias, Scope* alias_scope,
                                         const NamePart& part, Scope* scope) {
  TemplateValues values;
  if (template_depth_ >= kMaxTemplateDepth ||
      !bind_arguments(alias->template_parameters, part.template_arguments, scope, values) ||
      !complete_arguments(alias->template_parameters, alias_scope, values)) {
    report(CheckId::kTemplateArguments, part.location, {std::string(alias->name)});
    return types_.error();
  }
  ++template_depth_;
  const Type* type = parts_.resolver.resolve_type(
      alias->type, template_scope(alias->template_parameters, values, alias_scope));
  --template_depth_;
  return type;
}

void Templates::deduce_value(const Expr* expression, uint64_t value,
                             std::span<const TemplateParameter> parameters,
                             TemplateValues& values) {
  const auto* name = as<NameExpr>(expression);
  if (!name) return;
  const auto index = parameter_named(parameters, name->name);
  if (!index || values[*index].is_set()) return;
  values[*index].value = build_.literal(types_.scalar(Scalar::kInt64)->ir, {value});
}

// Returns false if `type` contradicts what is already deduced.
bool Templates::deduce(const TypeSyntax* syntax, const Type* type,
                       std::span<const TemplateParameter> parameters, TemplateValues& values) {
  if (syntax->kind == TypeSyntaxKind::kArray) {
    if (!type->is_array()) return true;
    if (syntax->array_size) deduce_value(syntax->array_size, type->count, parameters, values);
    return deduce(syntax->element, type->element, parameters, values);
  }
  if (syntax->kind != TypeSyntaxKind::kNamed) return true;
  if (const auto index = parameter_named(parameters, syntax->name)) {
    TemplateValue& value = values[*index];
    if (value.value) return true;
    const Type* plain = types_.settled(type);
    if (value.type) return same_type(value.type, plain) || is_literal(type->scalar);
    value.type = plain;
    return true;
  }
  const NamePart& part = syntax->name->last();
  const auto arguments = part.template_arguments;
  const auto deduce_type = [&](size_t i, const Type* element) {
    if (i >= arguments.size()) return true;
    if (arguments[i].type) return deduce(arguments[i].type, element, parameters, values);
    return true;
  };
  const auto deduce_number = [&](size_t i, uint64_t number) {
    if (i >= arguments.size()) return;
    if (arguments[i].value) deduce_value(arguments[i].value, number, parameters, values);
    if (arguments[i].type && arguments[i].type->kind == TypeSyntaxKind::kNamed) {
      const auto index = parameter_named(parameters, arguments[i].type->name);
      if (index && !values[*index].is_set()) {
        values[*index].value = build_.literal(types_.scalar(Scalar::kInt64)->ir, {number});
      }
    }
  };
  if (part.identifier == "vector" && (type->is_vector() || type->is_scalar())) {
    deduce_number(1, type->components());
    return deduce_type(0, types_.scalar(type->scalar));
  }
  if (part.identifier == "matrix" && type->is_matrix()) {
    deduce_number(1, type->rows);
    deduce_number(2, type->columns);
    return deduce_type(0, types_.scalar(type->scalar));
  }
  if (type->is_query() && part.identifier == resource_name(type->resource)) {
    deduce_number(0, type->ray_query_flags & ~shader::kRayQueryPermissions);
    deduce_number(1, shader::query_flags_of(type->ray_query_flags));
    return true;
  }
  if (type->is_resource() && part.identifier == resource_name(type->resource)) {
    return !type->element || deduce_type(0, type->element);
  }
  if (type->is_struct() && part.identifier == type->structure->template_name) {
    const TemplateValues& instance = program_.instance_arguments[type->structure].second;
    for (size_t i = 0; i < instance.size(); ++i) {
      if (instance[i].type) {
        if (!deduce_type(i, instance[i].type)) return false;
      } else {
        deduce_number(i, instance[i].value->literal[0]);
      }
    }
  }
  return true;
}

FunctionInfo* Templates::instantiate_function(FunctionInfo* function,
                                              std::span<const TemplateArgument> written,
                                              Scope* use_scope,
                                              const std::vector<Value>& arguments) {
  const FunctionDecl* decl = function->decl;
  std::vector<TemplateParameter> parameters(decl->template_parameters.begin(),
                                            decl->template_parameters.end());
  // The first declaration may be the one that has the default arguments.
  for (size_t i = 0; function->announced && i < parameters.size(); ++i) {
    const TemplateParameter& first = function->announced->template_parameters[i];
    if (!parameters[i].default_type) parameters[i].default_type = first.default_type;
    if (!parameters[i].default_value) parameters[i].default_value = first.default_value;
  }
  TemplateValues values;
  messages_.mute();
  bool fits = arguments.size() <= decl->parameters.size() &&
              bind_arguments(parameters, written, use_scope, values);
  // Arguments that are not literals decide first: in f(x, 1), x determines the type.
  for (const bool literals : {false, true}) {
    for (size_t i = 0; fits && i < arguments.size(); ++i) {
      const Type* type = arguments[i].type;
      if (!type || type->is_error()) continue;
      if ((type->is_numeric() && is_literal(type->scalar)) != literals) continue;
      fits = deduce(decl->parameters[i]->type, type, parameters, values);
    }
  }
  fits = fits && complete_arguments(parameters, function->scope, values);
  FunctionInfo* instance = nullptr;
  if (fits) {
    const std::string suffix = template_suffix(values);
    FunctionInfo*& slot = function->instances[suffix];
    if (!slot && template_depth_ < kMaxTemplateDepth) {
      ++template_depth_;
      Scope* inner = template_scope(parameters, values, function->scope);
      slot = parts_.functions.make_function(decl, inner, function->owner);
      slot->is_template = false;
      slot->is_static = function->is_static;
      slot->qualified += suffix;
      slot->template_suffix = suffix;
      slot->template_values = values;
      slot->sequence = function->sequence;
      slot->body_sequence = ~0u;
      const uint32_t visible = scopes_.visible;
      scopes_.visible = ~0u;
      parts_.functions.resolve_signature(slot);
      for (size_t i = 0; function->announced && i < slot->parameters.size(); ++i) {
        const Expr*& value = slot->parameters[i].default_value;
        if (!value) value = function->announced->parameters[i]->default_value;
      }
      scopes_.visible = visible;
      --template_depth_;
    }
    instance = slot;
  }
  messages_.unmute();
  return instance && !instance->signature_failed ? instance : nullptr;
}

}  // namespace kaamos::hlsl
