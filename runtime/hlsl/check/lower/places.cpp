// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/places.h"

#include <algorithm>
#include <functional>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/layout.h"
#include "runtime/hlsl/ir/builtin_types.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {
namespace {

bool innermost_row_major(const Type* type) {
  while (type->is_array()) type = type->element;
  return type->is_matrix() && type->row_major;
}

}  // namespace

Value Places::place(const ir::Variable* variable, const Type* type, bool is_const) {
  Value value = rvalue(build_.read(variable), type);
  value.is_place = true;
  value.is_const = is_const;
  return value;
}

// Returns whether no later statement can change the expression's value.
bool Places::is_fixed(const ir::Expr* expr) {
  switch (expr->kind) {
    case ir::ExprKind::kVariable:
      return expr->variable->name.empty() || expr->variable->is_const ||
             expr->variable->storage == ir::Storage::kConstant;
    case ir::ExprKind::kLoad:
    case ir::ExprKind::kLoadElement:
    case ir::ExprKind::kTypedLoad: {
      const ir::Type* type = expr->operands[0]->type;
      if (traits_of(type->resource).is_writable) return false;
      break;
    }
    case ir::ExprKind::kSystemValue:
      if (expr->system_value == ir::SystemValue::kRayTCurrent) return false;
      break;
    default:
      break;
  }
  return std::all_of(expr->operands.begin(), expr->operands.end(), is_fixed);
}

bool Places::mentions(const ir::Expr* expr, const ir::Variable* variable) {
  if (!expr) return false;
  if (expr->kind == ir::ExprKind::kVariable && expr->variable == variable) return true;
  return std::any_of(expr->operands.begin(), expr->operands.end(),
                     [&](const ir::Expr* operand) { return mentions(operand, variable); });
}

// Keeps the place, but saves the values of its indices at `position` in the block.
const ir::Expr* Places::freeze_place(const ir::Expr* expr, size_t* position) {
  if (expr->kind == ir::ExprKind::kVariable || expr->operands.empty()) return expr;
  const ir::Expr* base = freeze_place(expr->operands[0], position);
  std::vector<const ir::Expr*> operands = expr->operands;
  operands[0] = base;
  for (size_t i = 1; i < operands.size(); ++i) {
    if (!is_fixed(operands[i])) operands[i] = build_.read(body_.temporary(operands[i], position));
  }
  if (operands == expr->operands) return expr;
  ir::Expr* copy = build_.expr(expr->kind, expr->type);
  *copy = *expr;
  copy->operands = operands;
  return copy;
}

// The expression's current value, whatever follows. An element of a resource array stays an
// element, but with a fixed index, because that is how backends look it up.
const ir::Expr* Places::frozen(const ir::Expr* expr, size_t* position) {
  if (!expr || is_fixed(expr)) return expr;
  if (expr->kind != ir::ExprKind::kBinding) return build_.read(body_.temporary(expr, position));
  ir::Expr* copy = build_.expr(expr->kind, expr->type);
  *copy = *expr;
  for (const ir::Expr*& operand : copy->operands) operand = frozen(operand, position);
  BindingInfo* binding = binding_of_.at(expr);
  binding->uses.push_back(copy);
  binding_of_[copy] = binding;
  return copy;
}

void Places::freeze(Value& value, size_t* position) {
  if (value.under_cast) {
    Value place = *value.under_cast;
    freeze(place, position);
    value.under_cast = std::make_shared<const Value>(std::move(place));
  }
  const auto fix = [&](const ir::Expr*& expr) { expr = frozen(expr, position); };
  if (value.kind == ValueKind::kExpr && value.is_place) {
    value.expr = freeze_place(value.expr, position);
    return;
  }
  fix(value.expr);
  fix(value.element);
  fix(value.offset);
  fix(value.coordinates);
  fix(value.mip);
}

const ir::Expr* Places::load(const Value& value) {
  if (value.saved) return value.saved;
  if (value.bits) {
    const ir::Expr* unit = load(lower_.bit_fields.unit_of(value));
    return unit ? lower_.bit_fields.extract_bits(unit, *value.bits) : nullptr;
  }
  if (value.type && value.type->is_query()) {
    report(CheckId::kRayQueryCopy, value.location, {to_string(value.type)});
    return nullptr;
  }
  switch (value.kind) {
    case ValueKind::kExpr:
      return value.expr;
    case ValueKind::kTyped: {
      const Type* type = value.whole ? value.whole : value.type;
      ir::Expr* node = build_.expr(ir::ExprKind::kTypedLoad, types_.texel_of(type)->ir,
                                   {value.expr, value.coordinates});
      if (value.mip) node->operands.push_back(value.mip);
      const ir::Expr* texel_value = lower_.textures.from_texel(node, type);
      if (value.element) return build_.element(texel_value, value.element);
      return value.whole ? build_.swizzle(texel_value, value.components) : texel_value;
    }
    case ValueKind::kMemory: {
      const Type* type = value.whole ? value.whole : value.type;
      const auto read = [&](const Type* part, const ir::Expr* offset) {
        const auto kind = value.element ? ir::ExprKind::kLoadElement : ir::ExprKind::kLoad;
        ir::Expr* node = build_.expr(kind, part->ir, {value.expr});
        if (value.element) node->operands.push_back(value.element);
        node->operands.push_back(offset);
        node->layout = value.layout;
        node->row_major = innermost_row_major(part);
        return node;
      };
      const Type* scalar = types_.scalar(type->scalar);
      const uint32_t bytes =
          type->is_numeric() ? scalar_bytes(type->scalar, ScalarStorage::kBuffer) : 0;
      if (value.component_stride) {
        std::vector<const ir::Expr*> parts;
        const auto part = [&](uint32_t component) {
          return read(scalar, build_.add(value.offset, component * value.component_stride));
        };
        if (value.whole) {
          for (const uint8_t component : value.components) parts.push_back(part(component));
        } else {
          for (uint32_t i = 0; i < type->components(); ++i) parts.push_back(part(i));
        }
        return build_.construct(value.type->ir, std::move(parts));
      }
      if (!value.whole) return read(type, value.offset);
      if (type->is_matrix())
        return build_.matrix_swizzle(read(type, value.offset), value.components);
      if (value.components.size() == 1) {
        return read(scalar, build_.add(value.offset, value.components[0] * bytes));
      }
      return build_.swizzle(read(type, value.offset), value.components);
    }
    case ValueKind::kBindings: {
      const Type* type = value.type;
      uint64_t total = 1;
      for (const Type* part = type; part->is_array(); part = part->element) total *= part->count;
      if (total == 0 || total > 256) {
        report(CheckId::kUnsupported, value.location,
               {"an unbounded array of resources as a value"});
        return nullptr;
      }
      std::vector<const ir::Expr*> parts;
      for (uint32_t i = 0; i < type->count; ++i) {
        Value index = rvalue(build_.uint32(i), types_.scalar(Scalar::kUint32));
        const ir::Expr* part = load(lower_.elements.element_of(value, index, value.location));
        if (!part) return nullptr;
        parts.push_back(part);
      }
      return build_.construct(type->ir, std::move(parts));
    }
    case ValueKind::kSplit: {
      std::vector<const ir::Expr*> parts;
      for (const SplitPart& part : value.split->parts) {
        const ir::Expr* loaded = load(lower_.expressions.split_value(part, value.location));
        if (!loaded) return nullptr;
        parts.push_back(loaded);
      }
      return build_.construct(value.type->ir, std::move(parts));
    }
    case ValueKind::kHeap:
      report(CheckId::kHeapUntyped, value.location);
      return nullptr;
    case ValueKind::kMips:
      if (is_multisampled(value.type->resource)) {
        report(CheckId::kMipsUse, value.location, {"sample", "sample"});
      } else {
        report(CheckId::kMipsUse, value.location, {"mips", "level"});
      }
      return nullptr;
    case ValueKind::kInitList:
      report(CheckId::kInitListUse, value.location);
      return nullptr;
    case ValueKind::kError:
      return nullptr;
  }
  return nullptr;
}

uint32_t Places::component_bytes(const Value& target, uint32_t component) {
  const Type* whole = target.whole ? target.whole : target.type;
  const uint32_t bytes = scalar_bytes(whole->scalar, ScalarStorage::kBuffer);
  if (!whole->is_matrix()) {
    return component * (target.component_stride ? target.component_stride : bytes);
  }
  const uint32_t stride = matrix_stride(whole, target.layout);
  const uint32_t row = component / 4;
  const uint32_t column = component % 4;
  return whole->row_major ? row * stride + column * bytes : column * stride + row * bytes;
}

void Places::store_component(const Value& target, uint32_t component, const ir::Expr* value) {
  const uint32_t offset = component_bytes(target, component);
  const auto kind = target.element ? ir::StmtKind::kStoreElement : ir::StmtKind::kStore;
  ir::Stmt* statement = build_.stmt(kind);
  statement->operands.push_back(target.expr);
  if (target.element) statement->operands.push_back(target.element);
  statement->operands.push_back(build_.add(target.offset, offset));
  statement->value = value;
  statement->layout = target.layout;
  body_.emit(statement);
}

void Places::store_memory(const Value& target, const ir::Expr* value) {
  const bool by_component = target.whole || target.component_stride;
  if (by_component) {
    const uint32_t count = target.type->components();
    const ir::Expr* source = count == 1 ? value : build_.read(body_.temporary(value));
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t component = target.whole ? target.components[i] : i;
      store_component(target, component,
                      count == 1 ? source : build_.swizzle(source, {static_cast<uint8_t>(i)}));
    }
    return;
  }
  const auto kind = target.element ? ir::StmtKind::kStoreElement : ir::StmtKind::kStore;
  ir::Stmt* statement = build_.stmt(kind);
  statement->operands.push_back(target.expr);
  if (target.element) statement->operands.push_back(target.element);
  statement->operands.push_back(target.offset);
  statement->value = value;
  statement->layout = target.layout;
  statement->row_major = innermost_row_major(target.type);
  body_.emit(statement);
}

void Places::store(const Value& target, const ir::Expr* value) {
  if (!value) return;
  if (target.bits) {
    const Value unit = lower_.bit_fields.unit_of(target);
    store(unit, lower_.bit_fields.insert_bits(load(unit), *target.bits, value));
  } else if (target.kind == ValueKind::kMemory) {
    store_memory(target, value);
  } else if (target.kind == ValueKind::kTyped) {
    const ir::Expr* stored = value;
    if (target.whole) {
      // To write part of a texel: read it, change it, write it back.
      Value all = target;
      all.whole = nullptr;
      all.element = nullptr;
      all.saved = nullptr;
      all.components.clear();
      all.type = target.whole;
      const ir::Expr* source = build_.read(body_.temporary(value));
      const ir::Variable* texel_value = body_.temporary(load(all));
      ir::Stmt* change = build_.stmt(ir::StmtKind::kAssign);
      const ir::Expr* place = build_.read(texel_value);
      change->place = target.element ? build_.element(place, target.element)
                                     : build_.swizzle(place, target.components);
      change->value = source;
      body_.emit(change);
      stored = build_.read(texel_value);
    }
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kTypedStore);
    statement->operands = {target.expr, target.coordinates};
    statement->value = lower_.textures.to_texel(stored, target.whole ? target.whole : target.type);
    body_.emit(statement);
  } else if (target.kind == ValueKind::kExpr) {
    assigned_.insert(ir::root_of(target.expr));
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kAssign);
    statement->place = target.expr;
    statement->value = value;
    body_.emit(statement);
  }
}

Value Places::field_of(const Value& base, uint32_t index, const Type* type) {
  if (base.saved) return rvalue(build_.field(base.saved, index), type);
  if (base.kind == ValueKind::kSplit) {
    return lower_.expressions.split_value(base.split->parts[index], base.location);
  }
  Value result = base;
  result.type = type;
  if (base.kind == ValueKind::kMemory) {
    const uint32_t offset = field_offset(*base.type->structure, index, base.layout);
    result.offset = build_.add(base.offset, offset);
    return result;
  }
  const ir::Expr* expr = load(base);
  if (!expr) return error_value();
  result.kind = ValueKind::kExpr;
  result.expr = build_.field(expr, index);
  return result;
}

Value Places::base_of(const Value& value, StructInfo* base) {
  Value result = value;
  while (!result.failed() && result.type->structure != base && result.type->structure->base) {
    result = field_of(result, 0, result.type->structure->base->type);
  }
  return result;
}

bool Places::require_place(const Value& value, SourceLocation location, std::string_view purpose) {
  if (value.failed()) return false;
  if (value.is_const) {
    report(CheckId::kConstPlace, location, {std::string(purpose)});
    return false;
  }
  const bool stores = value.kind == ValueKind::kExpr || value.kind == ValueKind::kMemory ||
                      value.kind == ValueKind::kTyped;
  if (!value.is_place || !stores) {
    report(CheckId::kNotAPlace, location, {std::string(purpose)});
    return false;
  }
  return true;
}

bool Places::require_target(const Value& value, SourceLocation location, std::string_view purpose) {
  return require_place(value.under_cast ? *value.under_cast : value, location, purpose);
}

Value Places::place_under_cast(const Value& value) {
  const Value& place = *value.under_cast;
  const uint32_t count = value.type->components();
  if (count == place.type->components()) return place;
  std::vector<uint8_t> components;
  for (uint8_t i = 0; i < count; ++i) components.push_back(i);
  return lower_.elements.component_of(place, components);
}

const ir::Expr* Places::binding_value(BindingInfo* binding, const ir::Expr* index) {
  ir::Expr* node = build_.expr(ir::ExprKind::kBinding, binding->type->ir);
  if (binding->is_array) node->operands.push_back(build_.convert(index, Scalar::kUint32));
  binding->uses.push_back(node);
  binding_of_[node] = binding;
  if (body_.function) body_.function->bindings.push_back(binding);
  return node;
}

}  // namespace kaamos::hlsl
