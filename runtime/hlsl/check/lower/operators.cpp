// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/operators.h"

#include <algorithm>

#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {
namespace {

ir::BinaryOp ir_operator(BinaryOp op) {
  switch (op) {
    case BinaryOp::kMul:
      return ir::BinaryOp::kMultiply;
    case BinaryOp::kDiv:
      return ir::BinaryOp::kDivide;
    case BinaryOp::kRem:
      return ir::BinaryOp::kModulo;
    case BinaryOp::kAdd:
      return ir::BinaryOp::kAdd;
    case BinaryOp::kSub:
      return ir::BinaryOp::kSubtract;
    case BinaryOp::kShl:
      return ir::BinaryOp::kShiftLeft;
    case BinaryOp::kShr:
      return ir::BinaryOp::kShiftRight;
    case BinaryOp::kLess:
      return ir::BinaryOp::kLess;
    case BinaryOp::kGreater:
      return ir::BinaryOp::kGreater;
    case BinaryOp::kLessEqual:
      return ir::BinaryOp::kLessEqual;
    case BinaryOp::kGreaterEqual:
      return ir::BinaryOp::kGreaterEqual;
    case BinaryOp::kEqual:
      return ir::BinaryOp::kEqual;
    case BinaryOp::kNotEqual:
      return ir::BinaryOp::kNotEqual;
    case BinaryOp::kBitAnd:
    case BinaryOp::kLogicalAnd:
      return ir::BinaryOp::kBitAnd;
    case BinaryOp::kBitXor:
      return ir::BinaryOp::kBitXor;
    default:
      return ir::BinaryOp::kBitOr;
  }
}

std::string_view spelling(BinaryOp op) {
  static constexpr std::string_view kSpellings[] = {"*", "/", "%",  "+",  "-",  "<<", ">>",
                                                    "<", ">", "<=", ">=", "==", "!=", "&",
                                                    "^", "|", "&&", "||", ","};
  return kSpellings[static_cast<size_t>(op)];
}

// Returns the type that an enum and another operand are both converted to.
Scalar beside_enum(Scalar other) {
  if (other == Scalar::kLiteralFloat) return Scalar::kFloat32;
  return other == Scalar::kBool || other == Scalar::kLiteralInt ? Scalar::kInt32 : other;
}

bool is_bitwise(BinaryOp op) {
  return op == BinaryOp::kBitAnd || op == BinaryOp::kBitOr || op == BinaryOp::kBitXor;
}
bool is_shift(BinaryOp op) {
  return op == BinaryOp::kShl || op == BinaryOp::kShr;
}
bool is_comparison(BinaryOp op) {
  return op >= BinaryOp::kLess && op <= BinaryOp::kNotEqual;
}

}  // namespace

const Type* Operators::find_common_type(const Type* a, const Type* b, bool& truncates) {
  truncates = false;
  if (a->is_enum() && b->is_enum()) return same_type(a, b) ? a : nullptr;
  const Scalar scalar = a->is_enum()   ? beside_enum(b->scalar)
                        : b->is_enum() ? beside_enum(a->scalar)
                                       : combined_scalar(a->scalar, b->scalar);
  const auto single = [](const Type* type) { return type->is_scalar() || type->is_enum(); };
  if (single(a) && single(b)) return types_.scalar(scalar);
  if (single(a)) return types_.with_scalar(b, scalar);
  if (single(b)) return types_.with_scalar(a, scalar);
  // The one with more components if the other converts to it, or else the other. [DXC]
  const bool is_longer = a->components() >= b->components();
  const Type* longer = is_longer ? a : b;
  const Type* shorter = is_longer ? b : a;
  if (Conversions::convertible_numeric(shorter, longer)) {
    return types_.with_scalar(longer, scalar);
  }
  if (!Conversions::convertible_numeric(longer, shorter)) return nullptr;
  truncates = true;
  return types_.with_scalar(shorter, scalar);
}

const Type* Operators::find_joined_type(const Type* a, const Type* b, bool& truncates) {
  if (!a->is_matrix() || !b->is_matrix()) return find_common_type(a, b, truncates);
  const Scalar scalar = combined_scalar(a->scalar, b->scalar);
  truncates = a->rows != b->rows || a->columns != b->columns;
  return types_.matrix(scalar, std::min(a->rows, b->rows), std::min(a->columns, b->columns));
}

const Type* Operators::common_type(const Type* a, const Type* b, SourceLocation location,
                                   bool& truncates) {
  const Type* type = find_common_type(a, b, truncates);
  if (!type) report(CheckId::kNoCommonType, location, {to_string(a), to_string(b)});
  return type;
}

std::optional<Value> Operators::overloaded_operator(std::string_view name, const Value& left,
                                                    std::vector<Value> arguments,
                                                    SourceLocation location) {
  NamePart part;
  part.location = location;
  part.identifier = name;
  if (left.type->is_struct()) {
    Symbol* symbol = names_.find_member(left.type->structure, name);
    if (symbol && symbol->kind == SymbolKind::kFunctions) {
      return lower_.calls.call_functions(symbol->functions, part, &left, std::move(arguments),
                                         location);
    }
  }
  Symbol* symbol = names_.find(body_.scope, name);
  if (!symbol || symbol->kind != SymbolKind::kFunctions) return std::nullopt;
  arguments.insert(arguments.begin(), left);
  return lower_.calls.call_functions(symbol->functions, part, nullptr, std::move(arguments),
                                     location);
}

Value Operators::lower_unary(const UnaryExpr* expr) {
  const bool unused = body_.result_unused;
  body_.result_unused = false;
  Value operand = lower_.expressions.lower(expr->operand);
  body_.result_unused = unused;
  if (operand.failed()) return operand;
  at(expr->location);
  if (expr->op >= UnaryOp::kPreIncrement) return lower_increment(expr, operand);
  if (operand.type && operand.type->is_struct()) {
    static constexpr std::string_view kNames[] = {"operator+", "operator-", "operator!",
                                                  "operator~"};
    if (auto result = overloaded_operator(kNames[static_cast<size_t>(expr->op)], operand, {},
                                          expr->location)) {
      return *result;
    }
  }
  const ir::Expr* value = lower_.places.load(operand);
  if (!value) return error_value();
  const Type* type = operand.type;
  const bool is_unscoped = type->is_enum() && !type->enumeration->is_class;
  if (!type->is_numeric() && !is_unscoped) {
    report(CheckId::kOperand, expr->location, {"this operator", to_string(type)});
    return error_value();
  }
  if (expr->op == UnaryOp::kNot) {
    const Type* boolean = types_.with_scalar(type, Scalar::kBool);
    return rvalue(build_.unary(ir::UnaryOp::kNot, build_.convert(value, Scalar::kBool)), boolean);
  }
  // Arithmetic on a bool is done on an int.
  if (type->scalar == Scalar::kBool) {
    type = types_.with_scalar(type, Scalar::kInt32);
    value = build_.convert(value, Scalar::kInt32);
  }
  if (expr->op == UnaryOp::kPlus) return rvalue(value, type);
  if (expr->op == UnaryOp::kMinus) return rvalue(build_.unary(ir::UnaryOp::kNegate, value), type);
  if (is_floating(type->scalar)) {
    report(CheckId::kOperand, expr->location, {"'~'", to_string(type)});
    return error_value();
  }
  return rvalue(build_.unary(ir::UnaryOp::kBitNot, value), type);
}

Value Operators::lower_increment(const UnaryExpr* expr, const Value& operand) {
  if (!lower_.places.require_target(operand, expr->location, "the operand of ++ or --"))
    return error_value();
  const Type* type = operand.type;
  if (!type->is_numeric() || type->scalar == Scalar::kBool) {
    report(CheckId::kOperand, expr->location, {"++ or --", to_string(type)});
    return error_value();
  }
  const bool up = expr->op == UnaryOp::kPreIncrement || expr->op == UnaryOp::kPostIncrement;
  const bool post = expr->op == UnaryOp::kPostIncrement || expr->op == UnaryOp::kPostDecrement;
  Value target = operand.under_cast ? lower_.places.place_under_cast(operand) : operand;
  size_t position = body_.block->size();
  lower_.places.freeze(target, &position);
  const ir::Expr* before = lower_.conversions.convert(target, type, expr->location, true);
  if (post && !body_.result_unused) before = build_.read(body_.temporary(before));
  const Value one = rvalue(build_.literal(types_.scalar(Scalar::kLiteralInt)->ir, {1}),
                           types_.scalar(Scalar::kLiteralInt));
  const ir::Expr* step =
      lower_.conversions.convert(one, types_.with_scalar(type, type->scalar), expr->location);
  const Value after =
      rvalue(build_.binary(up ? ir::BinaryOp::kAdd : ir::BinaryOp::kSubtract, before, step), type);
  lower_.places.store(target, lower_.conversions.convert(after, target.type, expr->location, true));
  if (post) return rvalue(before, type);
  if (!operand.under_cast) return target;
  return rvalue(lower_.conversions.convert(target, type, expr->location, true), type);
}

Value Operators::binary_value(BinaryOp op, const Value& left, const Value& right,
                              SourceLocation location) {
  if (left.failed() || right.failed()) return error_value();
  at(location);
  if (!left.type || !right.type) {
    lower_.places.load(left.type ? right : left);
    return error_value();
  }
  const auto numeric = [](const Type* type) { return type->is_numeric() || type->is_enum(); };
  if (left.type->is_struct() || right.type->is_struct()) {
    if (auto result =
            overloaded_operator("operator" + std::string(spelling(op)), left, {right}, location)) {
      return *result;
    }
  }
  if (!numeric(left.type) || !numeric(right.type)) {
    report(CheckId::kOperands, location,
           {std::string(spelling(op)), to_string(left.type), to_string(right.type)});
    return error_value();
  }
  const bool is_class_enum = (left.type->is_enum() && left.type->enumeration->is_class) ||
                             (right.type->is_enum() && right.type->enumeration->is_class);
  const bool is_equality = op == BinaryOp::kEqual || op == BinaryOp::kNotEqual;
  const bool same = same_type(left.type, right.type);
  // The left operand decides what a shift results in, and a number does not become an enum.
  const bool is_number_in_enum = left.type->is_enum() && is_shift(op) && !same;
  const bool mixes = left.type->is_enum() && right.type->is_enum() && !same;
  if ((is_class_enum && !(is_equality && same)) || is_number_in_enum || mixes) {
    report(CheckId::kOperands, location,
           {std::string(spelling(op)), to_string(left.type), to_string(right.type)});
    return error_value();
  }
  bool truncates = false;
  const Type* type = common_type(left.type, right.type, location, truncates);
  if (!type) return error_value();
  if (truncates) {
    const bool left_longer = left.type->components() > right.type->components();
    report(CheckId::kTruncation, location,
           {to_string(left_longer ? left.type : right.type), to_string(type)});
  }
  const bool logical = op == BinaryOp::kLogicalAnd || op == BinaryOp::kLogicalOr;
  if (logical) type = types_.with_scalar(type, Scalar::kBool);
  if (is_shift(op)) {
    const bool by_float = is_floating(right.type->scalar) && !is_floating(left.type->scalar);
    if (by_float) {
      report(CheckId::kShiftByFloat, location, {std::string(spelling(op)), to_string(right.type)});
    }
    // The left operand decides the type; a literal shifted by a variable is an int.
    const Type* own = left.type;
    Scalar scalar = own->scalar;
    if (scalar == Scalar::kLiteralInt && right.type->scalar != Scalar::kLiteralInt) {
      scalar = types_.settled(lower_.conversions.settle(left).type)->scalar;
    }
    if (scalar == Scalar::kBool) scalar = Scalar::kInt32;
    if (!type->is_enum()) type = types_.with_scalar(type, scalar);
  }
  const bool floating = is_floating(type->scalar);
  if (floating && (is_bitwise(op) || is_shift(op))) {
    report(CheckId::kIntegersOnly, location,
           {std::string(spelling(op)), to_string(left.type), to_string(right.type)});
    return error_value();
  }
  // bool & bool stays bool; other arithmetic on bools is done on ints.
  const bool keeps_bool = is_bitwise(op) || is_comparison(op) || logical;
  if (type->scalar == Scalar::kBool && !keeps_bool) type = types_.with_scalar(type, Scalar::kInt32);
  const auto operand = [&](const Value& value) -> const ir::Expr* {
    const ir::Expr* expr = lower_.places.load(value);
    if (!expr) return nullptr;
    if (same_type(value.type, type)) return expr;
    const Type* from = value.type->is_enum() ? types_.scalar(value.type->scalar) : value.type;
    at(location);
    if (is_shift(op) && &value == &right && from->is_scalar() == type->is_scalar() &&
        is_floating(from->scalar)) {
      return build_.convert(expr, plain_scalar(type->scalar));
    }
    return lower_.conversions.convert_numeric(expr, from, type);
  };
  const ir::Expr* a = operand(left);
  const ir::Expr* b = operand(right);
  if (!a || !b) return error_value();
  lower_.body_rules.check_divisor(ir_operator(op), b, location);
  const ir::Expr* result = build_.binary(ir_operator(op), a, b);
  if (is_comparison(op)) type = types_.with_scalar(type, Scalar::kBool);
  if (is_literal(type->scalar) && result->kind != ir::ExprKind::kLiteral &&
      type->components() == 1) {
    if (op == BinaryOp::kDiv || op == BinaryOp::kRem) {
      report(CheckId::kDivisionByZero, location);
      return error_value();
    }
  }
  return rvalue(result, type);
}

Value Operators::lower_binary(const BinaryExpr* expr) {
  if (expr->op == BinaryOp::kLogicalAnd || expr->op == BinaryOp::kLogicalOr) {
    return lower_.short_circuits.lower_logical(expr);
  }
  if (expr->op == BinaryOp::kComma) {
    lower_.statements.lower_discarded(expr->left);
    return lower_.expressions.lower(expr->right);
  }
  const Expr* operands[] = {expr->left, expr->right};
  std::vector<Value> values = lower_.expressions.lower_all(operands, false);
  return binary_value(expr->op, values[0], values[1], expr->location);
}

Value Operators::lower_assign(const AssignExpr* expr) {
  // The value is evaluated before the place, as in DXC.
  const bool unused = body_.result_unused;
  body_.result_unused = false;
  Value value = lower_.expressions.lower(expr->value);
  size_t position = body_.block->size();
  const uint64_t effects = body_.effects;
  Value target = lower_.expressions.lower(expr->target);
  body_.result_unused = unused;
  if (value.failed() || target.failed()) return error_value();
  if (body_.effects != effects && value.type) {
    const ir::Expr* loaded = lower_.places.load(value);
    if (!loaded) return error_value();
    if (!lower_.places.is_fixed(loaded))
      value = rvalue(build_.read(body_.temporary(loaded, &position)), value.type);
  }
  at(expr->location);
  if (target.type && target.type->is_query() && lower_.ray_queries.rename_query(expr, value)) {
    return rvalue(build_.int32(0), types_.void_type());
  }
  if (!lower_.places.require_target(target, expr->location, "the left side of an assignment")) {
    return error_value();
  }
  if (target.under_cast) return assign_through_cast(expr, target, std::move(value));
  if (expr->op) {
    if (target.type->is_struct()) {
      const std::string name = "operator" + std::string(spelling(*expr->op)) + "=";
      if (auto result = overloaded_operator(name, target, {value}, expr->location)) return *result;
    }
    // `v += w` truncates w if it is longer than v; if v is longer, v is not shortened.
    position = body_.block->size();
    lower_.places.freeze(target, &position);
    value = binary_value(*expr->op, target, value, expr->location);
    if (value.failed()) return error_value();
  }
  const ir::Expr* converted = lower_.conversions.convert(value, target.type, expr->location);
  if (!converted) return error_value();
  at(expr->location);
  if (!body_.result_unused) {
    position = body_.block->size();
    lower_.places.freeze(target, &position);
  }
  lower_.places.store(target, converted);
  return target;
}

Value Operators::assign_through_cast(const AssignExpr* expr, const Value& target, Value value) {
  const Type* type = target.type;
  Value place = lower_.places.place_under_cast(target);
  size_t position = body_.block->size();
  lower_.places.freeze(place, &position);
  const auto seen = [&] {
    return rvalue(lower_.conversions.convert(place, type, expr->location, true), type);
  };
  if (expr->op) value = binary_value(*expr->op, seen(), value, expr->location);
  const ir::Expr* converted = lower_.conversions.convert(value, type, expr->location);
  if (!converted) return error_value();
  at(expr->location);
  lower_.places.store(
      place, lower_.conversions.convert(rvalue(converted, type), place.type, expr->location, true));
  return seen();
}

}  // namespace kaamos::hlsl
