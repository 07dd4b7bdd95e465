// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/short_circuits.h"

#include <utility>
#include <vector>

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {
namespace {

bool is_number(const Value& value) {
  return value.type && (value.type->is_numeric() || value.type->is_enum());
}

}  // namespace

// Short-circuits on scalars; before HLSL 2021 it also works on vectors, component by component.
Value ShortCircuits::lower_logical(const BinaryExpr* expr) {
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
    return lower_.operators.binary_value(expr->op, left, right, expr->location);
  }
  const ir::Expr* a = lower_.conversions.as_condition(left, expr->left->location);
  body_.block = &right_block;
  const ir::Expr* b = lower_.conversions.as_condition(right, expr->right->location);
  body_.block = outer;
  if (!a || !b) return error_value();
  at(expr->location);
  const Type* boolean = types_.boolean();
  ir::Block skipped;
  if (!evaluate(a)) lower_.coverage.sides(right_block, skipped, expr->location);
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
  branch->orelse = std::move(skipped);
  body_.emit(branch);
  return rvalue(build_.read(result), boolean);
}

// The type that both sides are converted to; null after an error.
const Type* ShortCircuits::type_of_arms(const Value (&arms)[2], bool is_constant,
                                        SourceLocation location) {
  const Type* type = nullptr;
  if (arms[0].type && arms[1].type && same_type(arms[0].type, arms[1].type)) {
    type = arms[0].type;
  } else if (is_number(arms[0]) && is_number(arms[1])) {
    bool truncates = false;
    type = lower_.operators.common_type(arms[0].type, arms[1].type, location, truncates);
    if (!type) return nullptr;
    if (truncates) {
      const bool first = arms[0].type->components() > arms[1].type->components();
      report(CheckId::kTruncation, location,
             {to_string(arms[first ? 0 : 1].type), to_string(type)});
    }
  } else if (arms[0].type && lower_.conversions.rank(arms[1], arms[0].type).possible) {
    type = arms[0].type;
  } else if (arms[1].type && lower_.conversions.rank(arms[0], arms[1].type).possible) {
    type = arms[1].type;
  } else {
    report(CheckId::kNoCommonType, location,
           {arms[0].type ? to_string(arms[0].type) : "a heap element",
            arms[1].type ? to_string(arms[1].type) : "a heap element"});
    return nullptr;
  }
  if (type->is_numeric() && is_literal(type->scalar) && !is_constant) {
    const bool big =
        types_.settled(lower_.conversions.settle(arms[0]).type)->scalar == Scalar::kUint32 ||
        types_.settled(lower_.conversions.settle(arms[1]).type)->scalar == Scalar::kUint32;
    type = type->scalar == Scalar::kLiteralInt && big ? types_.with_scalar(type, Scalar::kUint32)
                                                      : types_.settled(type);
  }
  return type;
}

// Only the side that the condition chooses has its effects.
Value ShortCircuits::choose(const ConditionalExpr* expr, const ir::Expr* chosen,
                            const Value (&arms)[2], ir::Block (&blocks)[2]) {
  if (arms[0].type && arms[0].type->is_void() && arms[1].type && arms[1].type->is_void()) {
    ir::Stmt* branch = build_.stmt(ir::StmtKind::kIf);
    branch->value = chosen;
    branch->body = std::move(blocks[0]);
    branch->orelse = std::move(blocks[1]);
    body_.emit(branch);
    return arms[0];
  }
  const Type* type = type_of_arms(arms, chosen->kind == ir::ExprKind::kLiteral, expr->location);
  if (!type) return error_value();
  ir::Block* outer = body_.block;
  const Expr* sources[2] = {expr->if_true, expr->if_false};
  const ir::Expr* values[2];
  for (int i = 0; i < 2; ++i) {
    body_.block = &blocks[i];
    const bool quiet = is_number(arms[i]);
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

Value ShortCircuits::lower_conditional(const ConditionalExpr* expr) {
  const bool unused = body_.result_unused;
  body_.result_unused = false;
  Value condition = lower_.expressions.lower(expr->condition);
  ir::Block* outer = body_.block;
  const size_t position = body_.block->size();
  const uint64_t effects = body_.effects;
  ir::Block blocks[2];
  Value arms[2];
  const Expr* sources[2] = {expr->if_true, expr->if_false};
  const bool is_scalar =
      !condition.failed() && condition.kind == ValueKind::kExpr && condition.type->is_scalar();
  const auto known = is_scalar ? evaluate(condition.expr) : std::nullopt;
  for (int i = 0; i < 2; ++i) {
    const bool is_dead = known && ((*known)[0] != 0) == (i == 1);
    if (is_dead) ++body_.dead_depth;
    body_.block = &blocks[i];
    arms[i] = lower_.expressions.lower(sources[i]);
    if (is_dead) --body_.dead_depth;
  }
  body_.block = outer;
  body_.result_unused = unused;
  if (condition.failed() || arms[0].failed() || arms[1].failed()) return error_value();
  at(expr->location);
  if (!condition.type || !condition.type->is_numeric() || condition.type->is_scalar()) {
    const ir::Expr* chosen = lower_.conversions.as_condition(condition, expr->condition->location);
    if (!chosen) return error_value();
    if (!evaluate(chosen)) lower_.coverage.sides(blocks[0], blocks[1], expr->location);
    const auto is_element = [](const Value& value) {
      return value.kind == ValueKind::kHeap && value.offset;
    };
    if (is_element(arms[0]) && is_element(arms[1]) &&
        arms[0].is_sampler_heap == arms[1].is_sampler_heap) {
      // The element is chosen by its index.
      Value element = arms[0];
      for (Value& arm : arms) arm = rvalue(arm.offset, types_.scalar(Scalar::kUint32));
      element.offset = choose(expr, chosen, arms, blocks).expr;
      return element.offset ? element : error_value();
    }
    return choose(expr, chosen, arms, blocks);
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
