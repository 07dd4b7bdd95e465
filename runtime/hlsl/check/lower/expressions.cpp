// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/expressions.h"

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/layout.h"
#include "runtime/hlsl/ir/builtin_functions.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {
namespace {

constexpr int kMaxDepth = 1000;

}  // namespace

Value Expressions::lower(const Expr* expression) {
  if (bench_.depth >= kMaxDepth) {
    report(CheckId::kTooDeep, expression->location, {std::to_string(kMaxDepth)});
    return error_value();
  }
  ++bench_.depth;
  at(expression->location);
  // All other kinds use each operand even if the result is unused.
  const ExprKind kind = expression->kind;
  const bool unused = body_.result_unused;
  body_.result_unused = unused && (kind == ExprKind::kCall || kind == ExprKind::kAssign ||
                                   kind == ExprKind::kConditional || kind == ExprKind::kUnary);
  Value value = lower_inner(expression);
  body_.result_unused = unused;
  value.location = expression->location;
  if (value.type && value.type->is_error()) value = error_value();
  --bench_.depth;
  return value;
}

Value Expressions::lower_inner(const Expr* expression) {
  switch (expression->kind) {
    case ExprKind::kError:
      return error_value();
    case ExprKind::kIntLiteral: {
      const auto* literal = static_cast<const IntLiteralExpr*>(expression);
      Scalar scalar = Scalar::kLiteralInt;
      if (literal->suffix == LiteralSuffix::kU) {
        scalar = literal->value > 0xFFFFFFFFu ? Scalar::kUint64 : Scalar::kUint32;
      } else if (literal->suffix == LiteralSuffix::kUL) {
        scalar = Scalar::kUint64;
      } else if (literal->suffix == LiteralSuffix::kL) {
        scalar = Scalar::kInt64;
      } else if (literal->value > INT64_MAX) {
        scalar = Scalar::kUint64;
      }
      const Type* type = types_.scalar(scalar);
      return rvalue(build_.literal(type->ir, {literal->value}), type);
    }
    case ExprKind::kFloatLiteral: {
      const auto* literal = static_cast<const FloatLiteralExpr*>(expression);
      Scalar scalar = Scalar::kLiteralFloat;
      if (literal->suffix == LiteralSuffix::kF) scalar = Scalar::kFloat32;
      if (literal->suffix == LiteralSuffix::kL) scalar = Scalar::kFloat64;
      if (literal->suffix == LiteralSuffix::kH) {
        scalar = names_.options().native_16bit ? Scalar::kFloat16 : Scalar::kHalf;
      }
      const Type* type = types_.scalar(scalar);
      return rvalue(
          build_.literal(type->ir, {normalise_bits(float_bits(literal->value), type->ir->scalar)}),
          type);
    }
    case ExprKind::kBoolLiteral:
      return rvalue(build_.boolean(static_cast<const BoolLiteralExpr*>(expression)->value),
                    types_.boolean());
    case ExprKind::kStringLiteral:
      report(CheckId::kStringUse, expression->location);
      return error_value();
    case ExprKind::kName:
      return lower_name(static_cast<const NameExpr*>(expression));
    case ExprKind::kThis:
      return lower_this(expression->location);
    case ExprKind::kMember:
      return lower_member(static_cast<const MemberExpr*>(expression));
    case ExprKind::kIndex:
      return lower_index(static_cast<const IndexExpr*>(expression));
    case ExprKind::kCall:
      return lower_.calls.lower_call(static_cast<const CallExpr*>(expression));
    case ExprKind::kConstruct: {
      const auto* construct = static_cast<const ConstructExpr*>(expression);
      const Type* type = names_.resolve_type(construct->type, body_.scope);
      return lower_construct(type, construct->arguments, construct->location);
    }
    case ExprKind::kCast:
      return lower_cast(static_cast<const CastExpr*>(expression));
    case ExprKind::kInitList: {
      Value value;
      value.kind = ValueKind::kInitList;
      value.init_list = static_cast<const InitListExpr*>(expression);
      return value;
    }
    case ExprKind::kUnary:
      return lower_.operators.lower_unary(static_cast<const UnaryExpr*>(expression));
    case ExprKind::kBinary:
      return lower_.operators.lower_binary(static_cast<const BinaryExpr*>(expression));
    case ExprKind::kAssign:
      return lower_.operators.lower_assign(static_cast<const AssignExpr*>(expression));
    case ExprKind::kConditional:
      return lower_.short_circuits.lower_conditional(
          static_cast<const ConditionalExpr*>(expression));
    case ExprKind::kSizeof:
      return lower_sizeof(static_cast<const SizeofExpr*>(expression));
  }
  return error_value();
}

// Evaluates left to right. An operand's value is saved before the effects of a later one if those
// could change it. With `keep_places` a place stays a place, and only its indices are saved; with
// `save_values` its contents are saved too.
std::vector<Value> Expressions::lower_all(std::span<const Expr* const> expressions,
                                          bool keep_places, bool save_values) {
  std::vector<Value> values;
  values.reserve(expressions.size());
  size_t fixed = 0;  // values[0..fixed) cannot change any more
  for (const Expr* expression : expressions) {
    const bool unused = body_.result_unused;
    body_.result_unused = false;
    size_t position = body_.block->size();
    const uint64_t effects = body_.effects;
    Value value = lower(expression);
    body_.result_unused = unused;
    if (body_.effects != effects) {
      for (; fixed < values.size(); ++fixed) {
        Value& earlier = values[fixed];
        if (earlier.failed() || earlier.kind == ValueKind::kInitList) continue;
        if (keep_places || !earlier.type || earlier.kind == ValueKind::kHeap ||
            earlier.kind == ValueKind::kBindings || earlier.kind == ValueKind::kMips) {
          lower_.places.freeze(earlier, &position);
          const bool is_memory =
              earlier.kind == ValueKind::kMemory || earlier.kind == ValueKind::kTyped;
          const bool is_query = earlier.type && earlier.type->is_query();
          if (save_values && !is_query && (earlier.kind == ValueKind::kExpr || is_memory)) {
            const ir::Expr* held = lower_.places.load(earlier);
            if (held && !lower_.places.is_fixed(held))
              earlier.saved = build_.read(body_.temporary(held, &position));
          }
          continue;
        }
        const ir::Expr* expr = lower_.places.load(earlier);
        if (!expr) {
          earlier = error_value();
        } else if (!lower_.places.is_fixed(expr)) {
          earlier = rvalue(lower_.places.frozen(expr, &position), earlier.type);
        }
      }
    }
    values.push_back(std::move(value));
  }
  return values;
}

Value Expressions::lower_this(SourceLocation location) {
  if (!body_.this_variable) {
    report(CheckId::kThisOutside, location);
    return error_value();
  }
  return lower_.places.place(body_.this_variable, body_.function->owner->type,
                             body_.function->is_const_method);
}

Value Expressions::variable_value(VariableInfo* variable, SourceLocation location) {
  if (variable->type->is_error()) return error_value();
  switch (variable->kind) {
    case VariableKind::kLocal:
      if (!variable->variable) lower_.locals.declare_variable(variable);
      ++variable->references;
      if (variable->constant) {
        Value value = rvalue(variable->constant, variable->type);
        value.is_const = true;
        return value;
      }
      return lower_.places.place(variable->variable, variable->type, variable->is_const);
    case VariableKind::kGlobal: {
      lower_.initialisers.initialise(variable);
      ++variable->references;
      if (variable->variable && variable->variable->storage == ir::Storage::kGroupShared) {
        lower_.intrinsics.use_in_stages(variable->name, ir::kStageCompute, location, true);
      }
      at(location);
      if (body_.function) body_.function->globals.push_back(variable);
      return lower_.places.place(variable->variable, variable->type, variable->is_const);
    }
    case VariableKind::kBufferMember:
      return memory(lower_.places.binding_value(variable->binding, nullptr), nullptr,
                    build_.uint32(variable->offset), variable->type, ir::Layout::kConstantBuffer,
                    true);
    case VariableKind::kBinding: {
      if (!variable->binding->is_array) {
        Value value =
            rvalue(lower_.places.binding_value(variable->binding, nullptr), variable->type);
        value.is_const = true;
        return value;
      }
      Value value;
      value.kind = ValueKind::kBindings;
      value.type = variable->type;
      value.is_const = true;
      value.binding = variable->binding;
      value.offset = build_.uint32(0);
      return value;
    }
    case VariableKind::kSplit:
      return split_value(variable->split, location);
  }
  return error_value();
}

Value Expressions::split_value(const SplitPart& part, SourceLocation location) {
  if (part.variable) return variable_value(part.variable, location);
  Value value;
  value.kind = ValueKind::kSplit;
  value.type = part.type;
  value.is_const = true;
  value.split = &part;
  return value;
}

Value Expressions::symbol_value(Symbol* symbol, SourceLocation location) {
  switch (symbol->kind) {
    case SymbolKind::kVariable:
      return variable_value(symbol->variable, location);
    case SymbolKind::kConstant:
      return rvalue(symbol->value, symbol->type);
    case SymbolKind::kFunctions:
      report(CheckId::kFunctionValue, location, {std::string(symbol->name)});
      return error_value();
    case SymbolKind::kField: {
      if (!body_.this_variable) {
        report(CheckId::kFieldOutside, location, {std::string(symbol->name)});
        return error_value();
      }
      return error_value();
    }
    default:
      report(CheckId::kNotAValue, location, {std::string(symbol->name)});
      return error_value();
  }
}

Value Expressions::lower_name(const NameExpr* expr) {
  const QualifiedName& name = *expr->name;
  if (name.is_simple()) {
    const std::string_view identifier = name.last().identifier;
    const bool is_sampler = identifier == "SamplerDescriptorHeap";
    const bool is_heap = (is_sampler || identifier == "ResourceDescriptorHeap") &&
                         !names_.resolve_name(name, body_.scope, true);
    if (is_heap) {
      lower_.body_rules.check_model(identifier, expr->location);
      Value value;
      value.kind = ValueKind::kHeap;
      value.is_sampler_heap = is_sampler;
      return value;
    }
  }
  Symbol* symbol = names_.resolve_name(name, body_.scope, true);
  if (!symbol) {
    if (name.is_simple() && is_builtin_function(name.last().identifier)) {
      report(CheckId::kFunctionValue, expr->location, {std::string(name.last().identifier)});
      return error_value();
    }
    if (auto constant = lower_.vk_names.vk_constant(name)) return *constant;
    names_.resolve_name(name, body_.scope, false);
    return error_value();
  }
  if (symbol->kind == SymbolKind::kField && body_.this_variable) {
    Value self = lower_this(expr->location);
    return member_of(self, name);
  }
  return symbol_value(symbol, expr->location);
}

Value Expressions::lower_member(const MemberExpr* expr) {
  Value base = lower(expr->base);
  if (base.failed()) return base;
  at(expr->location);
  return member_of(base, *expr->name);
}

Value Expressions::member_of(const Value& base, const QualifiedName& name) {
  const std::string_view member = name.last().identifier;
  const SourceLocation location = name.location;
  if (base.kind == ValueKind::kHeap || base.kind == ValueKind::kInitList ||
      base.kind == ValueKind::kMips) {
    lower_.places.load(base);
    return error_value();
  }
  const Type* type = base.type;
  if (type->is_resource()) {
    if (has_members(type->resource)) {
      const ir::Expr* resource = lower_.places.load(base);
      if (!resource) return error_value();
      return member_of(memory(resource, nullptr, build_.uint32(0), type->element,
                              ir::Layout::kConstantBuffer, true),
                       name);
    }
    const bool slices = is_multisampled(type->resource)
                            ? member == "sample"
                            : member == "mips" && is_sampled_texture(type->resource);
    if (slices) {
      Value value = base;
      value.kind = ValueKind::kMips;
      value.expr = lower_.places.load(base);
      value.offset = nullptr;
      return value.expr ? value : error_value();
    }
  }
  if (type->is_matrix()) return lower_.elements.matrix_swizzle_of(base, member, location);
  if (type->is_numeric()) return lower_.elements.swizzle_of(base, member, location);
  if (type->is_array() && type->count != 0 && member == "Length") {
    return rvalue(build_.uint32(type->count), types_.scalar(Scalar::kUint32));
  }
  if (!type->is_struct()) {
    report(CheckId::kNoMembers, location, {to_string(type), std::string(member)});
    return error_value();
  }
  StructInfo* structure = type->structure;
  Value object = base;
  if (name.parts.size() > 1) {
    // derived.Base::member
    for (StructInfo* info = structure; info; info = info->base) {
      const std::string_view qualifier = name.parts[name.parts.size() - 2].identifier;
      if (info->decl && info->decl->name == qualifier) {
        structure = info;
        object = lower_.places.base_of(base, info);
        break;
      }
    }
  }
  for (StructInfo* info = structure; info; info = info->base) {
    Symbol* symbol = names_.find_local(info->scope, member);
    if (!symbol) continue;
    if (symbol->kind != SymbolKind::kField) return symbol_value(symbol, location);
    const FieldInfo& field = info->fields[symbol->field];
    if (field.type->is_error()) return error_value();
    Value owner = lower_.places.base_of(object, info);
    if (owner.failed()) return owner;
    if (field.unit) return lower_.bit_fields.bit_field_of(owner, field);
    const Value result = lower_.places.field_of(owner, field.index, field.type);
    const bool is_access = info->is_payload && result.kind == ValueKind::kExpr &&
                           result.expr->kind == ir::ExprKind::kField;
    if (is_access) bench_.payloads.accesses[result.expr] = location.raw;
    return result;
  }
  names_.report_unknown(CheckId::kNoSuchMember, location, {to_string(type), std::string(member)},
                        member, structure->scope, false);
  return error_value();
}

Value Expressions::lower_index(const IndexExpr* expr) {
  const Expr* operands[] = {expr->base, expr->index};
  std::vector<Value> values = lower_all(operands, true);
  if (values[0].failed() || values[1].failed()) return error_value();
  at(expr->location);
  const Value& base = values[0];
  if (base.kind == ValueKind::kHeap && !base.offset) {
    const ir::Expr* index = lower_.elements.index_value(values[1], expr->index->location);
    if (!index) return error_value();
    Value value = base;
    value.offset = build_.convert(index, Scalar::kUint32);
    return value;
  }
  if (base.kind == ValueKind::kHeap || base.kind == ValueKind::kInitList) {
    lower_.places.load(base);
    return error_value();
  }
  if (base.kind == ValueKind::kMips || (base.type->is_resource())) {
    return lower_.resources.index_resource(base, values[1], expr->index->location);
  }
  if (base.type->is_struct()) {
    if (auto result =
            lower_.operators.overloaded_operator("operator[]", base, {values[1]}, expr->location)) {
      return *result;
    }
  }
  const bool indexable = base.type->is_array() || base.type->is_vector() ||
                         base.type->is_matrix() || base.type->is_single;
  if (!indexable) {
    report(CheckId::kNotIndexable, expr->location, {to_string(base.type)});
    return error_value();
  }
  return lower_.elements.element_of(base, values[1], expr->index->location);
}

Value Expressions::lower_cast(const CastExpr* expr) {
  const Type* type = names_.resolve_type(expr->type, body_.scope);
  Value operand = lower(expr->operand);
  if (operand.failed() || type->is_error()) return error_value();
  at(expr->location);
  if (type->is_void()) return rvalue(build_.zero(types_.scalar(Scalar::kInt32)->ir), type);
  // A cast to the same type or to a base stays a place.
  if (operand.is_place && operand.type && !operand.bits) {
    if (same_type(operand.type, type)) return operand;
    const bool is_base = operand.type->is_struct() && type->is_struct() &&
                         operand.kind != ValueKind::kSplit &&
                         lower_.conversions.rank(operand.type, type).possible;
    if (is_base) return lower_.places.base_of(operand, type->structure);
  }
  Value value = rvalue(lower_.conversions.convert(operand, type, expr->location, true), type);
  // `(float2)v = x` writes v.xy.
  const bool writes = operand.is_place && !operand.bits && operand.type->is_numeric() &&
                      type->is_numeric() &&
                      (type->components() == operand.type->components() ||
                       (type->components() < operand.type->components() &&
                        operand.type->is_vector() && !operand.type->is_long_vector()));
  if (!value.failed() && writes) value.under_cast = std::make_shared<const Value>(operand);
  return value;
}

Value Expressions::lower_construct(const Type* type, std::span<const Expr* const> arguments,
                                   SourceLocation location) {
  std::vector<Value> values = lower_all(arguments, false);
  if (type->is_error()) return error_value();
  at(location);
  for (const Value& value : values) {
    if (value.failed()) return error_value();
  }
  if (type->is_hit_object() && values.empty()) return rvalue(build_.zero(type->ir), type);
  if (!type->is_numeric()) {
    if (values.size() == 1 && (type->is_enum() || type->is_struct())) {
      return rvalue(lower_.conversions.convert(values[0], type, location, true), type);
    }
    report(CheckId::kNotConstructible, location, {to_string(type)});
    return error_value();
  }
  if (values.size() == 1 && values[0].type &&
      (values[0].type->is_scalar() || values[0].type->is_enum() || type->is_scalar() ||
       same_type(values[0].type, type))) {
    return rvalue(lower_.conversions.convert(values[0], type, location, true), type);
  }
  // Arrays and structs stand for their elements.
  for (size_t i = 0; i < values.size();) {
    const Type* from = values[i].type;
    const bool is_aggregate = from && (from->is_array() || from->is_struct()) &&
                              !contains_resource(from) && flat_component_count(from) <= 16;
    if (!is_aggregate) {
      ++i;
      continue;
    }
    const ir::Expr* whole = lower_.places.load(values[i]);
    if (!whole) return error_value();
    std::vector<Conversions::Piece> pieces;
    lower_.conversions.split({whole, from}, pieces);
    const SourceLocation place = values[i].location;
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(i));
    for (const Conversions::Piece& piece : pieces) {
      Value element = rvalue(piece.expr, piece.type);
      element.location = place;
      values.insert(values.begin() + static_cast<std::ptrdiff_t>(i), element);
    }
  }
  std::vector<const ir::Expr*> parts;
  uint32_t count = 0;
  for (const Value& value : values) {
    if (!value.type || !(value.type->is_numeric() || value.type->is_enum())) {
      report(CheckId::kConstructorArgument, value.location,
             {to_string(type), value.type ? to_string(value.type) : "an initialiser list"});
      return error_value();
    }
    const Type* from = value.type->is_enum() ? types_.scalar(value.type->scalar) : value.type;
    const ir::Expr* expr = lower_.places.load(value);
    if (!expr) return error_value();
    count += from->components();
    if (from->is_matrix()) {
      // As its elements, in row-major order.
      const ir::Expr* base = body_.repeatable(expr);
      for (uint8_t row = 0; row < from->rows; ++row) {
        for (uint8_t column = 0; column < from->columns; ++column) {
          parts.push_back(
              build_.convert(build_.matrix_swizzle(base, {static_cast<uint8_t>(row * 4 + column)}),
                             plain_scalar(type->scalar)));
        }
      }
    } else {
      parts.push_back(build_.convert(expr, plain_scalar(type->scalar)));
    }
  }
  if (count != type->components()) {
    report(CheckId::kConstructorCount, location,
           {to_string(type), std::to_string(type->components()), std::to_string(count)});
    return error_value();
  }
  return rvalue(build_.construct(type->ir, std::move(parts)), type);
}

Value Expressions::lower_sizeof(const SizeofExpr* expr) {
  const Type* type = nullptr;
  if (expr->type) {
    type = names_.resolve_type(expr->type, body_.scope);
  } else {
    ir::Block ignored;
    ir::Block* outer = body_.block;
    body_.block = &ignored;
    Value value = lower(expr->operand);
    body_.block = outer;
    if (value.failed() || !value.type) return error_value();
    if (!lower_.bit_fields.require_whole_field(value, expr->location, "the operand of sizeof"))
      return error_value();
    type = types_.settled(value.type);
  }
  if (type->is_error()) return error_value();
  if (type->is_void() || contains_resource(type) || contains_hit_object(type) ||
      (type->is_array() && type->count == 0)) {
    report(CheckId::kSizeof, expr->location, {to_string(type)});
    return error_value();
  }
  const Type* result = types_.scalar(Scalar::kUint32);
  return rvalue(build_.uint32(layout_of(type, ir::Layout::kStructured).size), result);
}

}  // namespace kaamos::hlsl
