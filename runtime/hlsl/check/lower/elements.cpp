// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/elements.h"

#include <algorithm>

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/layout.h"

namespace kaamos::hlsl {
namespace {

bool has_repeats(const std::vector<uint8_t>& components) {
  for (size_t i = 0; i < components.size(); ++i) {
    for (size_t j = i + 1; j < components.size(); ++j) {
      if (components[i] == components[j]) return true;
    }
  }
  return false;
}

}  // namespace

const ir::Expr* Elements::index_value(const Value& value, SourceLocation location) {
  if (value.failed() || !value.type || value.type->is_error()) return nullptr;
  const Type* type = value.type;
  if (!(type->is_numeric() && type->components() == 1) && !type->is_enum()) {
    report(CheckId::kIndexType, location, {to_string(type)});
    return nullptr;
  }
  const Scalar scalar = type->scalar;
  const bool is_unsigned = is_integer(scalar) && !is_signed_integer(scalar);
  return lower_.conversions.convert(
      value, types_.scalar(is_unsigned ? Scalar::kUint32 : Scalar::kInt32), location, true);
}

const Type* Elements::row_type(const Type* matrix) {
  return matrix->columns == 1 ? types_.single(matrix->scalar)
                              : types_.vector(matrix->scalar, matrix->columns);
}

Value Elements::memory_element(const Value& base, const ir::Expr* index) {
  Value result = base;
  const Type* type = base.type;
  if (base.whole) {
    // An element of a swizzle that has not been applied yet.
    if (index->kind == ir::ExprKind::kLiteral) {
      return component_of(base, {static_cast<uint8_t>(index->literal[0])});
    }
    const ir::Expr* expr = lower_.places.load(base);
    return rvalue(build_.element(expr, index), types_.scalar(type->scalar));
  }
  if (type->is_array()) {
    result.type = type->element;
    result.offset = build_.add_scaled(base.offset, index, array_stride(type->element, base.layout));
    return result;
  }
  const uint32_t bytes = scalar_bytes(type->scalar, ScalarStorage::kBuffer);
  if (type->is_vector()) {
    const uint32_t stride = base.component_stride ? base.component_stride : bytes;
    result.type = types_.scalar(type->scalar);
    result.component_stride = 0;
    result.offset = build_.add_scaled(base.offset, index, stride);
    return result;
  }
  const uint32_t stride = matrix_stride(type, base.layout);
  result.type = row_type(type);
  result.offset = build_.add_scaled(base.offset, index, type->row_major ? stride : bytes);
  if (!type->row_major && type->columns > 1) result.component_stride = stride;
  return result;
}

Value Elements::element_of(const Value& base, const Value& index, SourceLocation location) {
  if (base.failed() || index.failed()) return error_value();
  const Type* type = base.type;
  const uint32_t limit = type->is_array()    ? type->count
                         : type->is_matrix() ? type->rows
                         : type->is_single   ? 1
                                             : type->columns;
  const ir::Expr* at_index = index_value(index, location);
  if (!at_index) return error_value();
  if (const auto bits = evaluate(at_index)) {
    int64_t number = static_cast<int64_t>((*bits)[0]);
    // What never runs may have any index. [DXC]
    if (body_.dead_depth > 0 && limit != 0) number = std::clamp<int64_t>(number, 0, limit - 1);
    if (number < 0 || (limit != 0 && number >= limit)) {
      report(CheckId::kIndexRange, location, {std::to_string(number), std::to_string(limit)});
      return error_value();
    }
    at_index = build_.uint32(static_cast<uint64_t>(number));
  }
  if (type->is_single) {
    // Its only component, whatever the index.
    Value result = base;
    result.type = types_.scalar(type->scalar);
    return result;
  }
  if (base.kind == ValueKind::kSplit) {
    const Type* element = type;
    while (element->is_array()) element = element->element;
    const bool is_computed = base.offset || at_index->kind != ir::ExprKind::kLiteral;
    if (element->is_query() && is_computed) return lower_.ray_queries.element_of(base, at_index);
    if (at_index->kind == ir::ExprKind::kLiteral) {
      return lower_.expressions.split_value(base.split->parts[at_index->literal[0]], location);
    }
    report(CheckId::kSplitIndex, location, {to_string(type)});
    return error_value();
  }
  if (base.kind == ValueKind::kBindings) {
    Value result = base;
    result.type = type->element;
    uint32_t inner = 1;
    for (const Type* part = type->element; part->is_array(); part = part->element) {
      inner *= part->count;
    }
    result.offset = build_.add_scaled(base.offset, at_index, inner);
    if (result.type->is_array()) return result;
    return rvalue(lower_.places.binding_value(base.binding, result.offset), result.type);
  }
  if (base.kind == ValueKind::kMemory) return memory_element(base, at_index);
  const Type* element = type->is_array()    ? type->element
                        : type->is_matrix() ? row_type(type)
                                            : types_.scalar(type->scalar);
  if (base.kind == ValueKind::kTyped && at_index->kind == ir::ExprKind::kLiteral) {
    return component_of(base, {static_cast<uint8_t>(at_index->literal[0])});
  }
  if (base.kind == ValueKind::kTyped && !base.whole && base.is_place) {
    Value result = base;
    result.type = element;
    result.whole = type;
    result.element = at_index;
    return result;
  }
  Value result = base;
  const ir::Expr* expr = lower_.places.load(base);
  if (!expr) return error_value();
  if (expr->kind == ir::ExprKind::kConstruct || expr->kind == ir::ExprKind::kZero) {
    result.is_place = false;
    if (at_index->kind != ir::ExprKind::kLiteral) expr = build_.read(body_.temporary(expr));
  }
  result.kind = ValueKind::kExpr;
  result.type = element;
  result.expr = build_.element(expr, at_index);
  // Only a plain variable, field or element stays a place when it is indexed.
  if (base.kind != ValueKind::kExpr ||
      (expr->kind == ir::ExprKind::kSwizzle && at_index->kind != ir::ExprKind::kLiteral)) {
    result.is_place = false;
  }
  result.whole = nullptr;
  result.components.clear();
  return result;
}

Value Elements::component_of(const Value& base, const std::vector<uint8_t>& components) {
  if (base.bits) {
    if (components.size() == 1) return base;
    const Type* type = types_.vector(base.type->scalar, static_cast<uint32_t>(components.size()));
    return rvalue(build_.swizzle(lower_.places.load(base), components), type);
  }
  Value result = base;
  result.type = types_.vector(base.type->scalar, static_cast<uint32_t>(components.size()));
  if (has_repeats(components)) result.is_place = false;
  if (base.kind == ValueKind::kMemory || base.kind == ValueKind::kTyped) {
    const bool is_one_component = base.kind == ValueKind::kTyped && base.element;
    if (base.type->is_scalar() && (!base.whole || is_one_component)) {
      if (components.size() == 1) return base;
      const ir::Expr* expr = lower_.places.load(base);
      return expr ? rvalue(build_.swizzle(expr, components), result.type) : error_value();
    }
    result.components.clear();
    for (const uint8_t component : components) {
      result.components.push_back(base.whole ? base.components[component] : component);
    }
    result.whole = base.whole ? base.whole : base.type;
    return result;
  }
  const ir::Expr* expr = lower_.places.load(base);
  if (!expr) return error_value();
  result.expr = build_.swizzle(expr, components);
  return result;
}

Value Elements::swizzle_of(const Value& base, std::string_view text, SourceLocation location) {
  if (base.type->is_long_vector()) {
    report(CheckId::kLongSwizzle, location, {std::string(text), to_string(base.type)});
    return error_value();
  }
  const uint32_t size = base.type->is_scalar() ? 1 : base.type->columns;
  std::vector<uint8_t> components;
  int set = -1;
  bool valid = !text.empty() && text.size() <= 4;
  for (const char letter : text) {
    const size_t geometry = std::string_view("xyzw").find(letter);
    const size_t colour = std::string_view("rgba").find(letter);
    const int letter_set = geometry != std::string_view::npos ? 0 : 1;
    const size_t component = letter_set == 0 ? geometry : colour;
    if (component == std::string_view::npos || (set >= 0 && set != letter_set)) {
      valid = false;
      break;
    }
    set = letter_set;
    if (component >= size) {
      report(CheckId::kSwizzleRange, location,
             {std::string(1, letter), to_string(base.type), std::to_string(size)});
      return error_value();
    }
    components.push_back(static_cast<uint8_t>(component));
  }
  if (!valid) {
    report(CheckId::kSwizzle, location, {std::string(text), to_string(base.type)});
    return error_value();
  }
  return component_of(base, components);
}

Value Elements::matrix_swizzle_of(const Value& base, std::string_view text,
                                  SourceLocation location) {
  std::vector<uint8_t> components;
  bool valid = !text.empty();
  const bool zero_based = text.starts_with("_m");
  const size_t step = zero_based ? 4 : 3;
  for (size_t i = 0; valid && i < text.size(); i += step) {
    const std::string_view part = text.substr(i, step);
    valid = part.size() == step && part[0] == '_' && (part[1] == 'm') == zero_based &&
            components.size() < 4;
    if (!valid) break;
    const int row = part[step - 2] - (zero_based ? '0' : '1');
    const int column = part[step - 1] - (zero_based ? '0' : '1');
    valid = row >= 0 && row < 4 && column >= 0 && column < 4;
    if (valid && (row >= base.type->rows || column >= base.type->columns)) {
      report(CheckId::kSwizzleRange, location,
             {std::string(part), to_string(base.type),
              std::to_string(base.type->rows) + "x" + std::to_string(base.type->columns)});
      return error_value();
    }
    components.push_back(static_cast<uint8_t>(row * 4 + column));
  }
  if (!valid) {
    report(CheckId::kSwizzle, location, {std::string(text), to_string(base.type)});
    return error_value();
  }
  Value result = base;
  result.type = types_.vector(base.type->scalar, static_cast<uint32_t>(components.size()));
  if (has_repeats(components)) result.is_place = false;
  if (base.kind == ValueKind::kMemory) {
    result.whole = base.type;
    result.components = components;
    return result;
  }
  const ir::Expr* expr = lower_.places.load(base);
  if (!expr) return error_value();
  result.kind = ValueKind::kExpr;
  result.expr = build_.matrix_swizzle(expr, components);
  return result;
}

}  // namespace kaamos::hlsl
