// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/resolver.h"

#include "kaamos/shader/query_permissions.h"
#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/names/name_parts.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {
namespace {

constexpr int64_t kMaxArrayElements = 1 << 24;
constexpr int64_t kAllRayFlags = 0x3FF;
constexpr int64_t kForceOmm2State = 0x400;

// dx::linalg::Matrix and the like, of which `missing` is not declared.
bool names_linear_algebra(const QualifiedName& name, const NamePart& missing) {
  const bool in_dx = name.parts.size() > 1 && name.parts[0].identifier == "dx";
  return name.parts[in_dx ? 1 : 0].identifier == "linalg" &&
         (missing.identifier == "linalg" || missing.identifier == "dx");
}

}  // namespace

bool is_const_type(const TypeSyntax* syntax) {
  for (; syntax; syntax = syntax->element) {
    if (syntax->modifiers & kModConst) return true;
  }
  return false;
}

Scalar Resolver::scalar_of(ScalarKind kind, SourceLocation location) {
  const bool native = program_.options->native_16bit;
  const auto native_only = [&](Scalar scalar, std::string_view name) {
    if (!native) report(CheckId::kNeeds16Bit, location, {std::string(name)});
    return scalar;
  };
  switch (kind) {
    case ScalarKind::kBool:
      return Scalar::kBool;
    case ScalarKind::kInt:
      return Scalar::kInt32;
    case ScalarKind::kUint:
      return Scalar::kUint32;
    case ScalarKind::kHalf:
      return native ? Scalar::kFloat16 : Scalar::kHalf;
    case ScalarKind::kMin10Float:
      return native ? Scalar::kNativeMin10Float : Scalar::kMin10Float;
    case ScalarKind::kMin16Float:
      return native ? Scalar::kNativeMin16Float : Scalar::kMin16Float;
    case ScalarKind::kFloat:
      return Scalar::kFloat32;
    case ScalarKind::kDouble:
      return Scalar::kFloat64;
    case ScalarKind::kInt16:
      return native_only(Scalar::kInt16, "int16_t");
    case ScalarKind::kUint16:
      return native_only(Scalar::kUint16, "uint16_t");
    case ScalarKind::kFloat16:
      return native_only(Scalar::kFloat16, "float16_t");
    case ScalarKind::kInt64:
      return Scalar::kInt64;
    case ScalarKind::kUint64:
      return Scalar::kUint64;
    case ScalarKind::kMin12Int:
      return native ? Scalar::kNativeMin12Int : Scalar::kMin12Int;
    case ScalarKind::kMin16Int:
      return native ? Scalar::kNativeMin16Int : Scalar::kMin16Int;
    case ScalarKind::kMin16Uint:
      return native ? Scalar::kNativeMin16Uint : Scalar::kMin16Uint;
  }
  return Scalar::kInt32;
}

const Type* Resolver::apply_storage(const Type* type, Modifiers modifiers) {
  const bool row = (modifiers & kModRowMajor) != 0;
  const bool column = (modifiers & kModColumnMajor) != 0;
  if (!row && !column) return type;
  if (type->is_matrix()) {
    return types_.matrix(type->scalar, type->rows, type->columns, row);
  }
  if (type->is_array()) {
    return types_.array(apply_storage(type->element, modifiers), type->count);
  }
  return type;
}

bool Resolver::lacks_matrix_order(const TypeSyntax* syntax, Scope* scope) {
  if (syntax->modifiers & (kModRowMajor | kModColumnMajor)) return false;
  if (syntax->kind != TypeSyntaxKind::kNamed) return syntax->is_matrix();
  Symbol* symbol = resolve_name(*syntax->name, scope, true);
  if (!symbol) return syntax->name->is_simple() && syntax->name->last().identifier == "matrix";
  if (symbol->hidden) symbol = symbol->hidden;
  if (symbol->kind == SymbolKind::kAliasTemplate) {
    const TypeSyntax* type = symbol->alias->type;
    return type->pack_matrix == 0 && lacks_matrix_order(type, symbol->scope);
  }
  return symbol->kind == SymbolKind::kType && symbol->lacks_matrix_order;
}

// unorm and snorm say how the texels of a view of floats are stored.
const Type* Resolver::check_norm(const TypeSyntax* syntax, const Type* type) {
  const Modifiers norm = syntax->modifiers & (kModUnorm | kModSnorm);
  if (norm && type->is_numeric() && !is_floating(type->scalar)) {
    report(CheckId::kNormType, syntax->location,
           {(norm & kModUnorm) ? "unorm" : "snorm", to_string(type)});
  }
  return type;
}

const Type* Resolver::resolve_type(const TypeSyntax* syntax, Scope* scope) {
  if (!syntax) return types_.error();
  switch (syntax->kind) {
    case TypeSyntaxKind::kError:
      return types_.error();
    case TypeSyntaxKind::kVoid:
      return types_.void_type();
    case TypeSyntaxKind::kNumeric: {
      const Scalar scalar = scalar_of(syntax->scalar, syntax->location);
      const bool row_major =
          syntax->modifiers & kModRowMajor
              ? true
              : program_.options->row_major && !(syntax->modifiers & kModColumnMajor);
      if (syntax->rows == 0 && syntax->columns == 1) return types_.single(scalar);
      return check_norm(syntax, types_.numeric(scalar, syntax->rows, syntax->columns, row_major));
    }
    case TypeSyntaxKind::kNamed: {
      const Type* type = unsigned_twin(syntax, resolve_named(syntax, scope));
      const bool packs = syntax->pack_matrix != 0 && type->is_matrix();
      return check_norm(syntax, apply_storage(type, packs && lacks_matrix_order(syntax, scope)
                                                        ? syntax->pack_matrix
                                                        : syntax->modifiers));
    }
    case TypeSyntaxKind::kDefinition: {
      if (!syntax->definition) return types_.error();
      const auto found = program_.declared_types.find(syntax->definition);
      if (found != program_.declared_types.end()) return found->second;
      parts_.declarations.declare(syntax->definition, scope);
      const auto again = program_.declared_types.find(syntax->definition);
      return again == program_.declared_types.end() ? types_.error() : again->second;
    }
    case TypeSyntaxKind::kArray:
      return resolve_array(syntax, scope);
    case TypeSyntaxKind::kAuto:
      report(CheckId::kAutoWithoutValue, syntax->location, {"what is declared"});
      return types_.error();
  }
  return types_.error();
}

const Type* Resolver::resolve_variable_type(const VariableDecl* decl, Scope* scope) {
  if (decl->type->kind != TypeSyntaxKind::kAuto) {
    const Type* type = resolve_type(decl->type, scope);
    const Type* element = type;
    while (element->is_array()) element = element->element;
    const bool is_written = element->is_resource() && traits_of(element->resource).is_writable;
    const Modifiers coherent = decl->modifiers & (kModGloballyCoherent | kModReorderCoherent);
    if (coherent && !element->is_error() && !is_written) {
      report(CheckId::kCoherentType, decl->location,
             {std::string(decl->name), to_string(type),
              coherent & kModReorderCoherent ? "reordercoherent" : "globallycoherent"});
    }
    if ((coherent & kModReorderCoherent) && shader_model_minor(program_.options->target) < 9) {
      report(CheckId::kNeedsShaderModel, decl->location, {"reordercoherent", "6.9"});
    }
    return type;
  }
  Value value;
  if (decl->initializer) {
    value = parts_.evaluator.value_of(decl->initializer, scope);
    if (value.failed()) return types_.error();
  }
  if (!value.type || value.type->is_void() || value.type->is_query()) {
    report(CheckId::kAutoWithoutValue, decl->type->location, {std::string(decl->name)});
    return types_.error();
  }
  return types_.settled(value.type);
}

const Type* Resolver::resolve_array(const TypeSyntax* syntax, Scope* scope) {
  if (bench_.depth > 200) return types_.error();
  ++bench_.depth;
  const Type* element = resolve_type(syntax->element, scope);
  --bench_.depth;
  element = apply_storage(element, syntax->modifiers);
  if (element->is_error()) return element;
  if (element->is_void()) {
    report(CheckId::kVoidVariable, syntax->location, {"an array of void"});
    return types_.error();
  }
  if (element->is_array() && element->count == 0) {
    report(CheckId::kInnerUnbounded, syntax->location);
    return types_.error();
  }
  if (!syntax->array_size) return types_.array(element, 0);
  const auto size =
      parts_.evaluator.constant_integer(syntax->array_size, scope, "the size of an array");
  if (!size) return types_.error();
  const int64_t inner = static_cast<int64_t>(flat_component_count(element));
  if (*size < 1 || *size > kMaxArrayElements || *size * inner > kMaxArrayElements) {
    report(CheckId::kArraySize, syntax->array_size->location,
           {std::to_string(*size), std::to_string(kMaxArrayElements)});
    return types_.error();
  }
  return types_.array(element, static_cast<uint32_t>(*size));
}

// The type of `unsigned Index` for that of `Index`.
const Type* Resolver::unsigned_twin(const TypeSyntax* syntax, const Type* type) {
  if (!syntax->is_unsigned || type->is_error()) return type;
  const bool has_twin = type->is_numeric() && is_signed_integer(type->scalar);
  if (!has_twin) {
    report(CheckId::kUnsignedBase, syntax->location, {to_string(type)});
    return types_.error();
  }
  switch (type->scalar) {
    case Scalar::kInt64:
      return types_.with_scalar(type, Scalar::kUint64);
    case Scalar::kInt16:
      return types_.with_scalar(type, Scalar::kUint16);
    case Scalar::kInt32:
      return types_.with_scalar(type, Scalar::kUint32);
    default:
      return types_.with_scalar(type, scalar_bytes(type->scalar, ScalarStorage::kBuffer) == 2
                                          ? Scalar::kNativeMin16Uint
                                          : Scalar::kMin16Uint);
  }
}

bool Resolver::is_of_other_stage(const TypeSyntax* syntax, Scope* scope) {
  if (syntax->kind != TypeSyntaxKind::kNamed || !syntax->name->is_simple()) return false;
  return hlsl::is_of_other_stage(syntax->name->last().identifier) &&
         !resolve_name(*syntax->name, scope, true);
}

const Type* Resolver::resolve_named(const TypeSyntax* syntax, Scope* scope) {
  const QualifiedName& name = *syntax->name;
  Symbol* symbol = resolve_name(name, scope, true);
  if (!symbol) {
    if (name.is_simple()) {
      if (const Type* type = resolve_builtin(name.last(), syntax->location, scope)) return type;
      const std::string_view reason = unsupported_type(name.last().identifier);
      if (!reason.empty()) {
        report(CheckId::kUnsupported, syntax->location,
               {"'" + std::string(name.last().identifier) + "' (" + std::string(reason) + ")"});
        return types_.error();
      }
    }
    resolve_name(name, scope, false);
    return types_.error();
  }
  if (symbol->hidden) symbol = symbol->hidden;
  switch (symbol->kind) {
    case SymbolKind::kType:
      if (StructTemplate* own = parts_.templates.template_of(symbol, name.last())) {
        StructInfo* info =
            parts_.templates.instantiate_struct(own, name.last(), syntax->location, scope);
        return info ? info->type : types_.error();
      }
      if (name.last().has_template_arguments) {
        report(CheckId::kNotATemplate, syntax->location, {Scopes::spell(name)});
        return types_.error();
      }
      return symbol->type;
    case SymbolKind::kStructTemplate: {
      StructInfo* info = parts_.templates.instantiate_struct(symbol->struct_template, name.last(),
                                                             syntax->location, scope);
      return info ? info->type : types_.error();
    }
    case SymbolKind::kAliasTemplate:
      return parts_.templates.instantiate_alias(symbol->alias, symbol->scope, name.last(), scope);
    default:
      report(CheckId::kNotAType, syntax->location, {Scopes::spell(name)});
      return types_.error();
  }
}

const Type* Resolver::type_argument(const TemplateArgument& argument, Scope* scope) {
  if (argument.type) return resolve_type(argument.type, scope);
  // The parser takes a name that it does not know as a type to be a value.
  if (const auto* name = as<NameExpr>(argument.value)) {
    Symbol* symbol = resolve_name(*name->name, scope, true);
    if (symbol && symbol->kind == SymbolKind::kType) return symbol->type;
  }
  report(CheckId::kTypeArgument, argument.location);
  return types_.error();
}

std::optional<int64_t> Resolver::value_argument(const TemplateArgument& argument, Scope* scope,
                                                const Type** type) {
  if (argument.value)
    return parts_.evaluator.constant_integer(argument.value, scope, "a template argument", type);
  if (argument.type && argument.type->kind == TypeSyntaxKind::kNamed) {
    Symbol* symbol = resolve_name(*argument.type->name, scope, true);
    if (symbol && symbol->kind == SymbolKind::kConstant && symbol->value) {
      const auto value = evaluate(symbol->value);
      if (type) *type = symbol->type;
      if (value) return static_cast<int64_t>((*value)[0]);
    }
  }
  report(CheckId::kValueArgument, argument.location);
  return std::nullopt;
}

const Type* Resolver::resolve_builtin(const NamePart& part, SourceLocation location, Scope* scope) {
  const auto arguments = part.template_arguments;
  const bool is_vector = part.identifier == "vector";
  if (is_vector || part.identifier == "matrix") {
    Scalar scalar = Scalar::kFloat32;
    int64_t sizes[2] = {4, 4};
    if (!arguments.empty()) {
      const Type* element = type_argument(arguments[0], scope);
      if (element->is_error()) return element;
      if (!element->is_scalar()) {
        report(CheckId::kVectorElement, arguments[0].location, {to_string(element)});
        return types_.error();
      }
      scalar = element->scalar;
    }
    const size_t dimensions = is_vector ? 1 : 2;
    if (arguments.size() > dimensions + 1) {
      report(CheckId::kTemplateCount, location,
             {std::string(part.identifier), std::to_string(dimensions + 1),
              std::to_string(arguments.size())});
      return types_.error();
    }
    const bool is_long = is_vector && shader_model_minor(program_.options->target) >= 9;
    const int64_t most = is_long ? kMostLongComponents : kMostComponents;
    for (size_t i = 1; i < arguments.size(); ++i) {
      const auto size = value_argument(arguments[i], scope);
      if (!size) return types_.error();
      if (*size < 1 || *size > most) {
        report(CheckId::kVectorSize, arguments[i].location,
               {std::to_string(most), std::to_string(*size)});
        return types_.error();
      }
      sizes[i - 1] = *size;
    }
    if (is_vector && sizes[0] == 1) return types_.single(scalar);
    if (is_vector) return types_.vector(scalar, static_cast<uint32_t>(sizes[0]));
    return types_.matrix(scalar, static_cast<uint32_t>(sizes[0]), static_cast<uint32_t>(sizes[1]),
                         program_.options->row_major);
  }
  if (part.identifier == "string") return types_.string();
  if (stream_corners(part.identifier) != 0) return resolve_stream(part, scope);
  const ResourceTraits* traits = find_resource(part.identifier);
  return traits ? resolve_resource(*traits, part, scope) : nullptr;
}

// A stream has no value: what is appended goes out at once.
const Type* Resolver::resolve_stream(const NamePart& part, Scope* scope) {
  const auto arguments = part.template_arguments;
  const std::string name(part.identifier);
  if (arguments.size() != 1) {
    report(CheckId::kTemplateCount, part.location, {name, "1", std::to_string(arguments.size())});
    return types_.error();
  }
  const Type* vertex = type_argument(arguments[0], scope);
  if (vertex->is_error()) return vertex;
  if (!vertex->is_struct() || contains_resource(vertex)) {
    report(CheckId::kElementType, arguments[0].location, {name, "a struct", to_string(vertex)});
    return types_.error();
  }
  StructInfo*& known = streams_[{stream_corners(name), vertex->canonical}];
  if (!known) {
    known =
        parts_.structs.make_struct(nullptr, program_.global, name + "<" + to_string(vertex) + ">");
    ir::Field& field = known->ir->fields.emplace_back();
    field.name = "unused";
    field.type = types_.scalar(Scalar::kUint32)->ir;
    known->complete = true;
    known->stream_corners = stream_corners(name);
    known->stream_vertex = vertex;
  }
  return known->type;
}

const Type* Resolver::resolve_resource(const ResourceTraits& traits, const NamePart& part,
                                       Scope* scope) {
  const auto arguments = part.template_arguments;
  const std::string name(part.identifier);
  program_.facts.names_ordered_views = program_.facts.names_ordered_views || is_ordered_view(name);
  if (traits.kind == ir::ResourceKind::kRayQuery) return resolve_ray_query(part, scope);
  if (traits.element == ElementRule::kNone) {
    if (!arguments.empty()) report(CheckId::kNotATemplate, part.location, {name});
    return types_.resource(traits.kind, nullptr);
  }
  if (arguments.empty()) {
    if (traits.element == ElementRule::kTexel) {
      return types_.resource(traits.kind, types_.vector(Scalar::kFloat32, 4), false);
    }
    report(CheckId::kMissingElement, part.location, {name});
    return types_.error();
  }
  const Type* element = type_argument(arguments[0], scope);
  if (element->is_error()) return element;
  const size_t most = is_multisampled(traits.kind) ? 2 : 1;
  if (arguments.size() > most) {
    report(CheckId::kTemplateCount, part.location,
           {name, std::to_string(most), std::to_string(arguments.size())});
    return types_.error();
  }
  // The number of samples, which nothing depends on.
  if (arguments.size() == 2 && !value_argument(arguments[1], scope)) return types_.error();
  const bool texel = traits.element != ElementRule::kStruct;
  const bool fits = texel                      ? (element->is_scalar() || element->is_vector())
                    : has_members(traits.kind) ? element->is_struct()
                                               : (element->is_numeric() || element->is_struct() ||
                                                  element->is_enum() || element->is_array());
  if (contains_hit_object(element)) {
    report(CheckId::kHitObjectPlace, arguments[0].location, {"the elements of a " + name});
    return types_.error();
  }
  if (!fits || contains_resource(element)) {
    report(CheckId::kElementType, arguments[0].location,
           {name, texel ? "a scalar or vector" : "a struct or a numeric type", to_string(element)});
    return types_.error();
  }
  if (texel && element->is_long_vector()) {
    report(CheckId::kElementType, arguments[0].location,
           {name, "a scalar or a vector of up to 4 components", to_string(element)});
    return types_.error();
  }
  if (has_members(traits.kind) && contains_long_vector(element)) {
    report(CheckId::kLongVectorPlace, arguments[0].location,
           {"constant and texture buffers", to_string(element)});
    return types_.error();
  }
  if (texel && has_paired_texel(element) && element->components() > 2) {
    report(CheckId::kElementType, arguments[0].location,
           {name, "at most 128 bits", to_string(element)});
    return types_.error();
  }
  return types_.resource(traits.kind, element);
}

const Type* Resolver::resolve_ray_query(const NamePart& part, Scope* scope) {
  const auto arguments = part.template_arguments;
  const std::string name(part.identifier);
  if (arguments.empty() || arguments.size() > 2) {
    report(CheckId::kTemplateCount, part.location,
           {name, "1 or 2", std::to_string(arguments.size())});
    return types_.error();
  }
  const auto flags = value_argument(arguments[0], scope);
  if (!flags) return types_.error();
  const bool knows_micromaps = shader_model_minor(program_.options->target) >= 9;
  const int64_t most = knows_micromaps ? kAllRayFlags | kForceOmm2State : kAllRayFlags;
  if (*flags < 0 || *flags > most) {
    report(CheckId::kRayQueryFlags, arguments[0].location,
           {std::to_string(*flags), std::to_string(most)});
    return types_.error();
  }
  int64_t query_flags = 0;
  // [DXR: RAYQUERY_FLAG]
  if (arguments.size() == 2) {
    const auto written = value_argument(arguments[1], scope);
    if (!written) return types_.error();
    query_flags = *written;
    if (query_flags == 1 && !knows_micromaps) {
      report(CheckId::kNeedsShaderModel, arguments[1].location,
             {"RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS", "6.9"});
      return types_.error();
    }
    const int64_t known = shader_model_minor(program_.options->target) >= 10 ? 3 : 1;
    if (query_flags < 0 || query_flags > known) {
      report(CheckId::kRayQuerySecondFlags, arguments[1].location, {std::to_string(query_flags)});
      return types_.error();
    }
  }
  const uint32_t allowed = shader::query_permissions_of(static_cast<uint32_t>(query_flags));
  // [DXR: RAY_FLAG_FORCE_OMM_2_STATE]
  if ((*flags & kForceOmm2State) != 0 && (allowed & shader::kRayQueryAllowsMicromaps) == 0) {
    report(CheckId::kRayQueryMicromaps, arguments[0].location);
    return types_.error();
  }
  return types_.ray_query(static_cast<uint32_t>(*flags) | allowed);
}

// The scope that is named before a `::`.
Scope* Resolver::scope_of_part(const NamePart& part, Symbol* symbol, Scope* scope) {
  switch (symbol->kind) {
    case SymbolKind::kNamespace:
      return symbol->scope;
    case SymbolKind::kType:
      if (StructTemplate* own = parts_.templates.template_of(symbol, part)) {
        StructInfo* info = parts_.templates.instantiate_struct(own, part, part.location, scope);
        return info ? info->scope : nullptr;
      }
      if (symbol->scope) return symbol->scope;
      return symbol->type->is_struct() ? symbol->type->structure->scope : nullptr;
    case SymbolKind::kStructTemplate: {
      StructInfo* info =
          parts_.templates.instantiate_struct(symbol->struct_template, part, part.location, scope);
      return info ? info->scope : nullptr;
    }
    default:
      return symbol->hidden ? scope_of_part(part, symbol->hidden, scope) : nullptr;
  }
}

Symbol* Resolver::resolve_name(const QualifiedName& name, Scope* scope, bool quiet) {
  Scope* const global = program_.unit_scopes[scope->unit];
  Scope* in = name.is_global ? global : nullptr;
  Symbol* symbol = nullptr;
  for (const NamePart& part : name.parts) {
    symbol = in ? scopes_.find_in_scope(in, part.identifier, in->kind != ScopeKind::kStruct)
                : scopes_.find(scope, part.identifier);
    if (!symbol) {
      if (!quiet && names_linear_algebra(name, part)) {
        report(CheckId::kUnsupported, name.parts[0].location,
               {"'" + Scopes::spell(name) + "' (linear algebra, Shader Model 6.10)"});
      } else if (!quiet && !in && part.identifier == "dx" && name.parts.size() > 1) {
        report(CheckId::kNeedsShaderModel, name.parts[0].location, {Scopes::spell(name), "6.9"});
      } else if (!quiet) {
        const std::string where = in && in != global ? " in '" + in->name + "'" : "";
        scopes_.report_unknown(CheckId::kUndeclared, part.location,
                               {std::string(part.identifier), where}, part.identifier,
                               in ? in : scope, in == nullptr);
      }
      return nullptr;
    }
    if (&part == &name.parts.back()) break;
    in = scope_of_part(part, symbol, scope);
    if (!in) {
      if (!quiet) report(CheckId::kNotAScope, part.location, {std::string(part.identifier)});
      return nullptr;
    }
  }
  return symbol;
}

}  // namespace kaamos::hlsl
