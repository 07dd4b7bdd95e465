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
  if (a->is_vector() && b->is_vector()) {
    truncates = a->columns != b->columns;
    return types_.vector(scalar, std::min(a->columns, b->columns));
  }
  if (a->is_matrix() && b->is_matrix()) {
    const bool nested = (a->rows <= b->rows && a->columns <= b->columns) ||
                        (b->rows <= a->rows && b->columns <= a->columns);
    if (nested) {
      truncates = a->rows != b->rows || a->columns != b->columns;
      return types_.matrix(scalar, std::min(a->rows, b->rows), std::min(a->columns, b->columns));
    }
  } else if (a->components() == b->components()) {
    return types_.with_scalar(a->is_vector() ? a : b, scalar);
  }
  return nullptr;
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
  if (!lower_.places.require_place(operand, expr->location, "the operand of ++ or --"))
    return error_value();
  const Type* type = operand.type;
  if (!type->is_numeric() || type->scalar == Scalar::kBool) {
    report(CheckId::kOperand, expr->location, {"++ or --", to_string(type)});
    return error_value();
  }
  const bool up = expr->op == UnaryOp::kPreIncrement || expr->op == UnaryOp::kPostIncrement;
  const bool post = expr->op == UnaryOp::kPostIncrement || expr->op == UnaryOp::kPostDecrement;
  Value target = operand;
  size_t position = body_.block->size();
  lower_.places.freeze(target, &position);
  const ir::Expr* before = lower_.places.load(target);
  if (post && !body_.result_unused) before = build_.read(body_.temporary(before));
  const Value one = rvalue(build_.literal(types_.scalar(Scalar::kLiteralInt)->ir, {1}),
                           types_.scalar(Scalar::kLiteralInt));
  const ir::Expr* step =
      lower_.conversions.convert(one, types_.with_scalar(type, type->scalar), expr->location);
  lower_.places.store(
      target, build_.binary(up ? ir::BinaryOp::kAdd : ir::BinaryOp::kSubtract, before, step));
  return post ? rvalue(before, type) : target;
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
    return lower_logical(expr);
  }
  if (expr->op == BinaryOp::kComma) {
    lower_.statements.lower_discarded(expr->left);
    return lower_.expressions.lower(expr->right);
  }
  const Expr* operands[] = {expr->left, expr->right};
  std::vector<Value> values = lower_.expressions.lower_all(operands, false);
  return binary_value(expr->op, values[0], values[1], expr->location);
}

// Short-circuits on scalars; before HLSL 2021 it also works on vectors, component by component.
Value Operators::lower_logical(const BinaryExpr* expr) {
  const bool is_and = expr->op == BinaryOp::kLogicalAnd;
  Value left = lower_.expressions.lower(expr->left);
  const uint64_t effects = body_.effects;
  const size_t before = body_.block->size();
  ir::Block right_block;
  ir::Block* outer = body_.block;
  body_.block = &right_block;
  Value right = lower_.expressions.lower(expr->right);
  body_.block = outer;
  if (left.failed() || right.failed()) return error_value();
  at(expr->location);
  const auto is_single = [](const Value& value) {
    return value.type && (value.type->is_scalar() || value.type->is_enum());
  };
  if (!is_single(left) || !is_single(right)) {
    const bool vectors =
        left.type && right.type && left.type->is_numeric() && right.type->is_numeric();
    if (vectors && names_.options().hlsl_version >= 2021) {
      report(CheckId::kVectorLogic, expr->location, {is_and ? "&&" : "||", is_and ? "and" : "or"});
    }
    if (body_.effects != effects) {
      size_t position = before;
      if (const ir::Expr* value = lower_.places.load(left)) {
        left = rvalue(build_.read(body_.temporary(value, &position)), left.type);
      }
    }
    body_.block->insert(body_.block->end(), right_block.begin(), right_block.end());
    return binary_value(expr->op, left, right, expr->location);
  }
  const ir::Expr* a = lower_.conversions.as_condition(left, expr->left->location);
  body_.block = &right_block;
  const ir::Expr* b = lower_.conversions.as_condition(right, expr->right->location);
  body_.block = outer;
  if (!a || !b) return error_value();
  at(expr->location);
  const Type* boolean = types_.boolean();
  if (right_block.empty()) {
    if (a->kind == ir::ExprKind::kLiteral) {
      return rvalue((a->literal[0] != 0) == is_and ? b : a, boolean);
    }
    return rvalue(build_.expr(is_and ? ir::ExprKind::kLogicalAnd : ir::ExprKind::kLogicalOr,
                              boolean->ir, {a, b}),
                  boolean);
  }
  if (names_.options().hlsl_version < 2021) {
    const ir::Expr* first = build_.read(body_.temporary(a));
    body_.block->insert(body_.block->end(), right_block.begin(), right_block.end());
    return rvalue(build_.binary(is_and ? ir::BinaryOp::kBitAnd : ir::BinaryOp::kBitOr, first, b),
                  boolean);
  }
  const ir::Variable* result = body_.temporary(a);
  ir::Stmt* branch = build_.stmt(ir::StmtKind::kIf);
  const ir::Expr* read = build_.read(result);
  branch->value = is_and ? read : build_.unary(ir::UnaryOp::kNot, read);
  body_.block = &right_block;
  body_.assign(result, b);
  body_.block = outer;
  branch->body = std::move(right_block);
  body_.emit(branch);
  return rvalue(build_.read(result), boolean);
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
  if (!lower_.places.require_place(target, expr->location, "the left side of an assignment")) {
    return error_value();
  }
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

Value Operators::lower_conditional(const ConditionalExpr* expr) {
  const bool unused = body_.result_unused;
  body_.result_unused = false;
  Value condition = lower_.expressions.lower(expr->condition);
  ir::Block* outer = body_.block;
  const size_t position = body_.block->size();
  const uint64_t effects = body_.effects;
  ir::Block blocks[2];
  Value arms[2];
  const Expr* sources[2] = {expr->if_true, expr->if_false};
  for (int i = 0; i < 2; ++i) {
    body_.block = &blocks[i];
    arms[i] = lower_.expressions.lower(sources[i]);
  }
  body_.block = outer;
  body_.result_unused = unused;
  if (condition.failed() || arms[0].failed() || arms[1].failed()) return error_value();
  at(expr->location);
  if (!condition.type || !condition.type->is_numeric() || condition.type->is_scalar()) {
    const ir::Expr* chosen = lower_.conversions.as_condition(condition, expr->condition->location);
    if (!chosen) return error_value();
    if (arms[0].type && arms[0].type->is_void() && arms[1].type && arms[1].type->is_void()) {
      ir::Stmt* branch = build_.stmt(ir::StmtKind::kIf);
      branch->value = chosen;
      branch->body = std::move(blocks[0]);
      branch->orelse = std::move(blocks[1]);
      body_.emit(branch);
      return arms[0];
    }
    const Type* type = nullptr;
    const auto numeric = [](const Value& value) {
      return value.type && (value.type->is_numeric() || value.type->is_enum());
    };
    if (arms[0].type && arms[1].type && same_type(arms[0].type, arms[1].type)) {
      type = arms[0].type;
    } else if (numeric(arms[0]) && numeric(arms[1])) {
      bool truncates = false;
      type = common_type(arms[0].type, arms[1].type, expr->location, truncates);
      if (!type) return error_value();
      if (truncates) {
        const bool first = arms[0].type->components() > arms[1].type->components();
        report(CheckId::kTruncation, expr->location,
               {to_string(arms[first ? 0 : 1].type), to_string(type)});
      }
    } else if (arms[0].type && lower_.conversions.rank(arms[1], arms[0].type).possible) {
      type = arms[0].type;
    } else if (arms[1].type && lower_.conversions.rank(arms[0], arms[1].type).possible) {
      type = arms[1].type;
    } else {
      report(CheckId::kNoCommonType, expr->location,
             {arms[0].type ? to_string(arms[0].type) : "a heap element",
              arms[1].type ? to_string(arms[1].type) : "a heap element"});
      return error_value();
    }
    if (type->is_numeric() && is_literal(type->scalar) && chosen->kind != ir::ExprKind::kLiteral) {
      const bool big =
          types_.settled(lower_.conversions.settle(arms[0]).type)->scalar == Scalar::kUint32 ||
          types_.settled(lower_.conversions.settle(arms[1]).type)->scalar == Scalar::kUint32;
      type = type->scalar == Scalar::kLiteralInt && big ? types_.with_scalar(type, Scalar::kUint32)
                                                        : types_.settled(type);
    }
    const ir::Expr* values[2];
    for (int i = 0; i < 2; ++i) {
      body_.block = &blocks[i];
      const bool quiet = numeric(arms[i]);
      values[i] = lower_.conversions.convert(arms[i], type, sources[i]->location, quiet);
    }
    body_.block = outer;
    if (!values[0] || !values[1]) return error_value();
    at(expr->location);
    if (blocks[0].empty() && blocks[1].empty()) {
      return rvalue(build_.conditional(chosen, values[0], values[1]), type);
    }
    if (names_.options().hlsl_version < 2021) {
      const ir::Expr* test = build_.read(body_.temporary(chosen));
      body_.block->insert(body_.block->end(), blocks[0].begin(), blocks[0].end());
      const ir::Expr* first = build_.read(body_.temporary(values[0]));
      body_.block->insert(body_.block->end(), blocks[1].begin(), blocks[1].end());
      return rvalue(build_.conditional(test, first, values[1]), type);
    }
    const ir::Variable* result = body_.empty_temporary(type->ir);
    ir::Stmt* branch = build_.stmt(ir::StmtKind::kIf);
    branch->value = chosen;
    for (int i = 0; i < 2; ++i) {
      body_.block = &blocks[i];
      body_.assign(result, values[i]);
    }
    body_.block = outer;
    branch->body = std::move(blocks[0]);
    branch->orelse = std::move(blocks[1]);
    body_.emit(branch);
    return rvalue(build_.read(result), type);
  }
  // A vector condition selects per component and evaluates both sides.
  if (names_.options().hlsl_version >= 2021) {
    report(CheckId::kVectorLogic, expr->location, {"?:", "select"});
  }
  if (body_.effects != effects) {
    size_t at_position = position;
    if (const ir::Expr* value = lower_.places.load(condition)) {
      condition = rvalue(build_.read(body_.temporary(value, &at_position)), condition.type);
    }
  }
  for (ir::Block& arm : blocks) body_.block->insert(body_.block->end(), arm.begin(), arm.end());
  std::vector<Value> arguments = {condition, arms[0], arms[1]};
  return lower_.intrinsics.call_select(arguments, expr->location);
}

}  // namespace kaamos::hlsl
