// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/conversions.h"

#include <algorithm>
#include <functional>

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {
namespace {

constexpr size_t kMaxScalars = 1u << 15;

// Adds the kind of each scalar that the type holds; false if it holds anything else, or too much.
bool add_scalars(const Type* type, std::vector<Scalar>& scalars) {
  if (type->is_array()) {
    for (uint32_t i = 0; i < type->count; ++i) {
      if (!add_scalars(type->element, scalars)) return false;
    }
    return true;
  }
  if (type->is_struct()) {
    const StructInfo& structure = *type->structure;
    if (structure.base && !add_scalars(structure.base->type, scalars)) return false;
    return std::all_of(
        structure.fields.begin(), structure.fields.end(),
        [&](const FieldInfo& field) { return !field.unit && add_scalars(field.type, scalars); });
  }
  if (!type->is_numeric() || scalars.size() > kMaxScalars) return false;
  scalars.insert(scalars.end(), type->components(), plain_scalar(type->scalar));
  return true;
}

bool is_anonymous(const Type* type) {
  return type->structure->decl && type->structure->decl->name.empty();
}

}  // namespace

// A matrix of one row or column is like a vector, which can be longer than its target; any other
// one and a vector must have the same number of components.
bool Conversions::convertible_numeric(const Type* from, const Type* to) {
  const uint32_t given = from->components();
  const uint32_t wanted = to->components();
  if (given == 1 || wanted == 1) return true;
  if (from->is_matrix() && to->is_matrix()) {
    return from->rows >= to->rows && from->columns >= to->columns;
  }
  const Type* matrix = from->is_matrix() ? from : to;
  const bool is_line = !matrix->is_matrix() || matrix->rows == 1 || matrix->columns == 1;
  return is_line ? given >= wanted : given == wanted;
}

// Before HLSL 2021 also of structs, and later to those that a cast cannot name.
bool Conversions::is_base_of(const Type* base, const Type* type) {
  const StructInfo* structure = type->structure;
  while (structure && structure != base->structure) structure = structure->base;
  return structure != nullptr;
}

bool Conversions::same_scalars(const Type* from, const Type* to) const {
  const bool are_arrays = from->is_array() && to->is_array();
  const bool are_structs = from->is_struct() && to->is_struct() &&
                           (names_.options().hlsl_version < 2021 || is_anonymous(to));
  if (!are_arrays && !are_structs) return false;
  std::vector<Scalar> given;
  std::vector<Scalar> wanted;
  return add_scalars(from, given) && add_scalars(to, wanted) && given == wanted;
}

ConversionRank Conversions::rank(const Type* from, const Type* to) {
  ConversionRank result;
  if (from->is_error() || to->is_error()) {
    result.possible = true;
    return result;
  }
  if (same_type(from, to)) {
    result.possible = true;
    return result;
  }
  if (from->is_enum() && to->is_numeric() && !from->enumeration->is_class) {
    result.possible = true;
    result.cost = enum_cost(to->scalar) + size_cost(1, to->components());
    return result;
  }
  if (from->is_numeric() && to->is_numeric()) {
    result.possible = convertible_numeric(from, to);
    result.cost =
        scalar_cost(from->scalar, to->scalar) + size_cost(from->components(), to->components());
    return result;
  }
  // half[2] and float[2].
  if (from->is_array() && to->is_array() && from->ir == to->ir) {
    while (from->is_array()) from = from->element, to = to->element;
    result.possible = true;
    if (from->is_numeric() && to->is_numeric()) result.cost = scalar_cost(from->scalar, to->scalar);
    return result;
  }
  if (from->is_array() && same_scalars(from, to)) {
    result.possible = true;
    return result;
  }
  // `float a[]`: the array decides the size.
  if (from->is_array() && to->is_array() && (to->count == 0) != (from->count == 0) &&
      (to->count == 0 || !contains_resource(to->element))) {
    result.possible = from->element->ir == to->element->ir;
    return result;
  }
  if (from->is_struct() && to->is_struct()) {
    // The nearest base wins, where DXC calls several bases ambiguous.
    ConversionCost distance = 1;
    for (StructInfo* base = from->structure->base; base; base = base->base, ++distance) {
      if (base == to->structure) {
        result.possible = true;
        result.cost = size_cost(flat_component_count(from), flat_component_count(to)) + distance;
        return result;
      }
    }
  }
  if (from->is_struct() && same_scalars(from, to)) {
    result.possible = true;
    result.cost = 1;
    return result;
  }
  if (from->is_resource() && to->is_resource()) {
    result.possible = from->ir == to->ir;
    // Texture2D<half4> and Texture2D<float4> are one type only where half is float.
    const bool has_elements = from->element && to->element;
    if (result.possible && has_elements && !same_type(from->element, to->element)) result.cost = 1;
    return result;
  }
  if (from->is_resource() && has_members(from->resource) && to->is_struct()) {
    result = rank(from->element, to);
    ++result.cost;
  }
  return result;
}

ConversionRank Conversions::rank(const Value& value, const Type* to) {
  ConversionRank result;
  if (value.failed()) {
    result.possible = true;
    return result;
  }
  if (value.kind == ValueKind::kInitList) return result;
  if (value.kind == ValueKind::kHeap) {
    result.possible =
        value.offset && to->is_resource() && is_sampler(to->resource) == value.is_sampler_heap;
    return result;
  }
  return rank(value.type, to);
}

Value Conversions::settle(Value value) {
  if (value.failed() || !value.type || !value.type->is_numeric() ||
      !is_literal(value.type->scalar)) {
    return value;
  }
  Scalar scalar = value.type->scalar == Scalar::kLiteralInt ? Scalar::kInt32 : Scalar::kFloat32;
  if (scalar == Scalar::kInt32) {
    if (const auto bits = evaluate(value.expr)) {
      for (const uint64_t component : *bits) {
        const int64_t number = static_cast<int64_t>(component);
        if (number > INT64_C(0xFFFFFFFF) || number < INT64_C(-0x80000000)) {
          scalar = Scalar::kInt64;
        } else if (number > INT64_C(0x7FFFFFFF) && scalar == Scalar::kInt32) {
          scalar = Scalar::kUint32;
        }
      }
    }
  }
  const Type* type = types_.with_scalar(value.type, scalar);
  return rvalue(build_.convert(value.expr, plain_scalar(scalar)), type);
}

const ir::Expr* Conversions::convert_numeric(const ir::Expr* expr, const Type* from,
                                             const Type* to) {
  const Scalar scalar = plain_scalar(to->scalar);
  const bool same_shape = from->rows == to->rows && from->columns == to->columns;
  if (same_shape) return build_.convert(expr, scalar);
  if (from->is_matrix() && from->components() == 1) {
    return convert_numeric(build_.matrix_swizzle(expr, {0}), types_.scalar(from->scalar), to);
  }
  if (from->is_scalar()) return build_.splat(build_.convert(expr, scalar), to->ir);
  if (from->is_vector()) {
    if (to->is_scalar()) return build_.convert(build_.swizzle(expr, {0}), scalar);
    if (to->is_vector()) {
      const ir::Type* shorter = build_.vector_type(plain_scalar(from->scalar), to->columns);
      return build_.convert(build_.truncate(expr, shorter), scalar);
    }
    if (to->components() < from->components()) {
      const ir::Type* shorter =
          build_.vector_type(plain_scalar(from->scalar), static_cast<uint8_t>(to->components()));
      expr = to->components() == 1 ? build_.swizzle(expr, {0}) : build_.truncate(expr, shorter);
    }
    return build_.construct(to->ir, {build_.convert(expr, scalar)});
  }
  if (to->is_scalar()) return build_.convert(build_.matrix_swizzle(expr, {0}), scalar);
  if (to->is_long_vector()) {
    const ir::Expr* base = body_.repeatable(expr);
    std::vector<const ir::Expr*> rows;
    for (uint32_t row = 0; row < from->rows; ++row) {
      rows.push_back(build_.convert(build_.element(base, build_.uint32(row)), scalar));
    }
    return build_.construct(to->ir, std::move(rows));
  }
  if (to->is_vector()) {
    std::vector<uint8_t> components;
    for (uint8_t row = 0; row < from->rows; ++row) {
      for (uint8_t column = 0; column < from->columns; ++column) {
        components.push_back(static_cast<uint8_t>(row * 4 + column));
      }
    }
    components.resize(to->columns);
    return build_.convert(build_.matrix_swizzle(expr, components), scalar);
  }
  const bool truncates = from->rows >= to->rows && from->columns >= to->columns;
  if (truncates) {
    const Type* smaller = types_.matrix(from->scalar, to->rows, to->columns);
    return build_.convert(build_.truncate(expr, smaller->ir), scalar);
  }
  // The same number of components in another shape, such as 1x4 to 4x1.
  std::vector<const ir::Expr*> parts;
  const ir::Expr* base = body_.repeatable(expr);
  for (uint8_t row = 0; row < from->rows; ++row) {
    for (uint8_t column = 0; column < from->columns; ++column) {
      parts.push_back(build_.convert(
          build_.matrix_swizzle(base, {static_cast<uint8_t>(row * 4 + column)}), scalar));
    }
  }
  return build_.construct(to->ir, std::move(parts));
}

const ir::Expr* Conversions::convert(const Value& value, const Type* to, SourceLocation location,
                                     bool is_explicit) {
  if (value.failed() || to->is_error() || (value.type && value.type->is_error())) return nullptr;
  at(location);
  if (value.kind == ValueKind::kInitList) return lower_init_list(value.init_list, to);
  if (value.kind == ValueKind::kHeap) {
    if (!rank(value, to).possible) {
      report(CheckId::kHeapType, location,
             {value.is_sampler_heap ? "SamplerDescriptorHeap" : "ResourceDescriptorHeap",
              to_string(to)});
      return nullptr;
    }
    if (body_.function) {
      (value.is_sampler_heap ? body_.function->uses_sampler_heap : body_.function->uses_view_heap) =
          true;
    }
    return build_.expr(ir::ExprKind::kHeapResource, to->ir, {value.offset});
  }
  const Type* from = value.type;
  if (from->is_void()) {
    report(CheckId::kVoidValue, location);
    return nullptr;
  }
  const auto refuse = [&]() -> const ir::Expr* {
    report(is_explicit ? CheckId::kCast : CheckId::kConversion, location,
           {to_string(from), to_string(to)});
    return nullptr;
  };
  if (same_type(from, to)) return lower_.places.load(value);
  if (from->is_array() && to->is_array() && from->ir == to->ir) return lower_.places.load(value);
  const bool is_derived = from->is_struct() && to->is_struct() && is_base_of(to, from);
  if (!is_derived && same_scalars(from, to)) {
    const ir::Expr* expr = lower_.places.load(value);
    return expr ? build_from_pieces(to, {Piece{expr, from}}, location, false) : nullptr;
  }
  const bool numbers = (from->is_numeric() || from->is_enum()) && to->is_numeric();
  if (numbers) {
    if (from->is_enum() && from->enumeration->is_class && !is_explicit) return refuse();
    const Type* shape = from->is_enum() ? types_.scalar(from->scalar) : from;
    if (!convertible_numeric(shape, to)) return refuse();
    const bool truncates = !shape->is_scalar() && to->components() < shape->components();
    if (truncates && !is_explicit) {
      report(CheckId::kTruncation, location, {to_string(from), to_string(to)});
    }
    const ir::Expr* expr = lower_.places.load(value);
    return expr ? convert_numeric(expr, shape, to) : nullptr;
  }
  if (to->is_enum()) {
    if (!is_explicit || !(from->is_scalar() || from->is_enum())) return refuse();
    const ir::Expr* expr = lower_.places.load(value);
    return expr ? build_.convert(expr, plain_scalar(to->scalar)) : nullptr;
  }
  if (from->is_resource() && to->is_resource()) {
    return from->ir == to->ir ? lower_.places.load(value) : refuse();
  }
  if (from->is_resource() && has_members(from->resource) && to->is_struct() &&
      rank(from->element, to).possible) {
    const ir::Expr* resource = lower_.places.load(value);
    if (!resource) return nullptr;
    return convert(memory(resource, nullptr, build_.uint32(0), from->element,
                          ir::Layout::kConstantBuffer, true),
                   to, location);
  }
  if (from->is_struct() && to->is_struct() && rank(from, to).possible) {
    return lower_.places.load(lower_.places.base_of(value, to->structure));
  }
  const bool aggregates = (from->is_numeric() || from->is_struct() || from->is_array()) &&
                          (to->is_numeric() || to->is_struct() || to->is_array());
  if (!is_explicit || !aggregates || contains_resource(to) || contains_resource(from)) {
    return refuse();
  }
  const ir::Expr* expr = lower_.places.load(value);
  if (!expr) return nullptr;
  if (from->is_scalar()) {
    if (const auto bits = evaluate(expr);
        bits && convert_bits((*bits)[0], expr->type->scalar, Scalar::kBool) == 0) {
      return build_.zero(to->ir);
    }
    const uint64_t count = flat_component_count(to);
    if (count > 4096) return refuse();
    const ir::Expr* repeated = body_.repeatable(expr);
    return build_from_pieces(to, std::vector<Piece>(count, Piece{repeated, from}), location, false);
  }
  if (flat_component_count(to) > flat_component_count(from)) return refuse();
  return build_from_pieces(to, {Piece{expr, from}}, location, true);
}

// `queue` is a stack: the next piece is at its back.
void Conversions::split(const Piece& piece, std::vector<Piece>& queue) {
  const Type* type = piece.type;
  const ir::Expr* expr = body_.repeatable(piece.expr);
  std::vector<Piece> parts;
  if (type->is_vector()) {
    for (uint32_t i = 0; i < type->columns; ++i) {
      parts.push_back({build_.element(expr, build_.uint32(i)), types_.scalar(type->scalar)});
    }
  } else if (type->is_matrix()) {
    for (uint8_t row = 0; row < type->rows; ++row) {
      for (uint8_t column = 0; column < type->columns; ++column) {
        parts.push_back({build_.matrix_swizzle(expr, {static_cast<uint8_t>(row * 4 + column)}),
                         types_.scalar(type->scalar)});
      }
    }
  } else if (type->is_array()) {
    for (uint32_t i = 0; i < type->count; ++i) {
      parts.push_back({build_.element(expr, build_.uint32(i)), type->element});
    }
  } else if (type->is_struct()) {
    if (type->structure->base)
      parts.push_back({build_.field(expr, 0), type->structure->base->type});
    for (const FieldInfo& field : type->structure->fields) {
      if (field.is_padding()) continue;
      const ir::Expr* part = build_.field(expr, field.index);
      parts.push_back(
          {field.unit ? lower_.bit_fields.extract_bits(part, field) : part, field.type});
    }
  }
  queue.insert(queue.end(), parts.rbegin(), parts.rend());
}

const ir::Expr* Conversions::take(const Type* type, std::vector<Piece>& queue, bool& failed,
                                  SourceLocation location) {
  if (type->is_struct() && flat_component_count(type) == 0) return build_.zero(type->ir);
  if (failed || queue.empty()) {
    failed = true;
    return nullptr;
  }
  const Type* back = queue.back().type;
  if (same_type(back, type) || (back->is_array() && type->is_array() && back->ir == type->ir)) {
    const ir::Expr* expr = queue.back().expr;
    queue.pop_back();
    return expr;
  }
  std::vector<const ir::Expr*> parts;
  const auto take_part = [&](const Type* part) {
    parts.push_back(take(part, queue, failed, location));
  };
  if (type->is_scalar() || type->is_enum() || type->is_resource()) {
    while (!queue.empty() && (queue.back().type->is_array() || queue.back().type->is_struct() ||
                              queue.back().type->is_vector() || queue.back().type->is_matrix())) {
      const Piece piece = queue.back();
      queue.pop_back();
      split(piece, queue);
    }
    if (queue.empty()) {
      failed = true;
      return nullptr;
    }
    const Piece piece = queue.back();
    queue.pop_back();
    const ir::Expr* expr = convert(rvalue(piece.expr, piece.type), type, location);
    failed = failed || !expr;
    return expr;
  }
  // A vector of the same shape converts as a whole.
  const Type* next = queue.back().type;
  if (type->is_numeric() && next->is_numeric() && next->rows == type->rows &&
      next->columns == type->columns) {
    const Piece piece = queue.back();
    queue.pop_back();
    return convert_numeric(piece.expr, piece.type, type);
  }
  if (type->is_numeric()) {
    for (uint32_t i = 0; i < type->components() && !failed; ++i) {
      take_part(types_.scalar(type->scalar));
    }
  } else if (type->is_array()) {
    for (uint32_t i = 0; i < type->count && !failed; ++i) take_part(type->element);
  } else if (type->is_struct()) {
    if (type->structure->base) take_part(type->structure->base->type);
    for (const FieldInfo& field : type->structure->fields) {
      if (failed) break;
      if (!field.unit) {
        take_part(field.type);
        continue;
      }
      if (field.begins_field()) parts.push_back(build_.zero(field.unit->ir));
      if (field.is_padding()) continue;
      const ir::Expr* part = take(field.type, queue, failed, location);
      if (part) parts.back() = lower_.bit_fields.insert_bits(parts.back(), field, part);
    }
  } else {
    failed = true;
  }
  return failed ? nullptr : build_.construct(type->ir, std::move(parts));
}

const ir::Expr* Conversions::build_from_pieces(const Type* type, std::vector<Piece> pieces,
                                               SourceLocation location, bool allow_extra) {
  uint64_t available = 0;
  for (const Piece& piece : pieces) available += flat_component_count(piece.type);
  const uint64_t needed = flat_component_count(type);
  if (available < needed || (available > needed && !allow_extra)) {
    report(CheckId::kInitialiserCount, location,
           {to_string(type), std::to_string(needed), std::to_string(available)});
    return nullptr;
  }
  // The struct has no fields.
  if (needed == 0) return build_.zero(type->ir);
  std::reverse(pieces.begin(), pieces.end());
  bool failed = false;
  const size_t errors = messages_.error_count();
  const ir::Expr* result = take(type, pieces, failed, location);
  if (failed && errors == messages_.error_count()) {
    report(CheckId::kInitialiserCount, location,
           {to_string(type), std::to_string(needed), std::to_string(available)});
  }
  return failed ? nullptr : result;
}

void Conversions::collect_pieces(const InitListExpr* list, std::vector<Piece>& pieces, int depth) {
  std::vector<const Expr*> leaves;
  const std::function<void(const InitListExpr*, int)> gather = [&](const InitListExpr* at_list,
                                                                   int level) {
    if (level > 64) return;
    for (const Expr* element : at_list->elements) {
      if (const auto* nested = as<InitListExpr>(element)) {
        gather(nested, level + 1);
      } else {
        leaves.push_back(element);
      }
    }
  };
  gather(list, depth);
  for (Value& value : lower_.expressions.lower_all(leaves, false)) {
    if (value.failed()) {
      pieces.push_back({build_.zero(types_.scalar(Scalar::kFloat32)->ir), types_.error()});
      continue;
    }
    const ir::Expr* expr = lower_.places.load(value);
    pieces.push_back({expr ? expr : build_.int32(0), expr ? value.type : types_.error()});
  }
}

const ir::Expr* Conversions::lower_init_list(const InitListExpr* list, const Type* type) {
  if (type->is_error()) return nullptr;
  // `Texture2D t = {..}` and the like reduce to their only element.
  std::vector<Piece> pieces;
  collect_pieces(list, pieces, 0);
  for (const Piece& piece : pieces) {
    if (piece.type->is_error()) return nullptr;
    if (piece.type->is_void()) {
      report(CheckId::kVoidValue, list->location);
      return nullptr;
    }
  }
  at(list->location);
  return build_from_pieces(type, std::move(pieces), list->location, false);
}

const ir::Expr* Conversions::as_condition(const Value& value, SourceLocation location) {
  if (value.failed()) return nullptr;
  const Type* type = value.type;
  const bool is_unscoped = type && type->is_enum() && !type->enumeration->is_class;
  if (!type || !(type->is_scalar() || is_unscoped)) {
    const bool single = type && type->is_numeric() && type->components() == 1;
    if (!single) {
      report(CheckId::kConditionType, location, {type ? to_string(type) : "a resource"});
      return nullptr;
    }
  }
  return convert(value, types_.boolean(), location, true);
}

}  // namespace kaamos::hlsl
