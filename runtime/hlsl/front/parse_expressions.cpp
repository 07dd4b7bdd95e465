// SPDX-License-Identifier: MIT
// Expressions made of operators, from the comma down to prefix operators and casts.
#include <algorithm>
#include <utility>

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {
namespace {

struct BinaryInfo {
  BinaryOp op;
  int precedence;  // Higher binds tighter; 0: not a binary operator.
};

BinaryInfo binary_info(TokenKind kind) {
  switch (kind) {
    case TokenKind::kPipePipe:
      return {BinaryOp::kLogicalOr, 1};
    case TokenKind::kAmpAmp:
      return {BinaryOp::kLogicalAnd, 2};
    case TokenKind::kPipe:
      return {BinaryOp::kBitOr, 3};
    case TokenKind::kCaret:
      return {BinaryOp::kBitXor, 4};
    case TokenKind::kAmp:
      return {BinaryOp::kBitAnd, 5};
    case TokenKind::kEqualEqual:
      return {BinaryOp::kEqual, 6};
    case TokenKind::kExclaimEqual:
      return {BinaryOp::kNotEqual, 6};
    case TokenKind::kLess:
      return {BinaryOp::kLess, 7};
    case TokenKind::kGreater:
      return {BinaryOp::kGreater, 7};
    case TokenKind::kLessEqual:
      return {BinaryOp::kLessEqual, 7};
    case TokenKind::kGreaterEqual:
      return {BinaryOp::kGreaterEqual, 7};
    case TokenKind::kLessLess:
      return {BinaryOp::kShl, 8};
    case TokenKind::kGreaterGreater:
      return {BinaryOp::kShr, 8};
    case TokenKind::kPlus:
      return {BinaryOp::kAdd, 9};
    case TokenKind::kMinus:
      return {BinaryOp::kSub, 9};
    case TokenKind::kStar:
      return {BinaryOp::kMul, 10};
    case TokenKind::kSlash:
      return {BinaryOp::kDiv, 10};
    case TokenKind::kPercent:
      return {BinaryOp::kRem, 10};
    default:
      return {BinaryOp::kComma, 0};
  }
}

// Returns false if it is not an assignment operator.
bool assignment_operator(TokenKind kind, std::optional<BinaryOp>* op) {
  switch (kind) {
    case TokenKind::kEqual:
      *op = std::nullopt;
      return true;
    case TokenKind::kPlusEqual:
      *op = BinaryOp::kAdd;
      return true;
    case TokenKind::kMinusEqual:
      *op = BinaryOp::kSub;
      return true;
    case TokenKind::kStarEqual:
      *op = BinaryOp::kMul;
      return true;
    case TokenKind::kSlashEqual:
      *op = BinaryOp::kDiv;
      return true;
    case TokenKind::kPercentEqual:
      *op = BinaryOp::kRem;
      return true;
    case TokenKind::kLessLessEqual:
      *op = BinaryOp::kShl;
      return true;
    case TokenKind::kGreaterGreaterEqual:
      *op = BinaryOp::kShr;
      return true;
    case TokenKind::kAmpEqual:
      *op = BinaryOp::kBitAnd;
      return true;
    case TokenKind::kPipeEqual:
      *op = BinaryOp::kBitOr;
      return true;
    case TokenKind::kCaretEqual:
      *op = BinaryOp::kBitXor;
      return true;
    default:
      return false;
  }
}

}  // namespace

const Expr* Parser::finish(Expr* expr, std::initializer_list<const Expr*> children,
                           std::span<const Expr* const> more) {
  uint32_t height = std::exchange(pending_height_, 0);
  for (const Expr* child : children) {
    if (child != nullptr) height = std::max<uint32_t>(height, child->height + 1u);
  }
  for (const Expr* child : more) height = std::max<uint32_t>(height, child->height + 1u);
  if (height > kMaxHeight) {
    fail(DiagnosticId::kExpressionTooDeep, expr->location, {std::to_string(kMaxHeight)});
    return error_expr(expr->location);
  }
  expr->height = static_cast<uint16_t>(height);
  return expr;
}

const Expr* Parser::expression() {
  const Expr* left = assignment();
  while (!panic_ && at(Kind::kComma)) {
    BinaryExpr* comma = make<BinaryExpr>(here());
    advance();
    comma->op = BinaryOp::kComma;
    comma->left = left;
    comma->right = assignment();
    left = finish(comma, {comma->left, comma->right});
  }
  return left;
}

const Expr* Parser::assignment() {
  if (panic_) return error_expr(here());
  Nesting nesting(*this);
  if (!nesting.ok) return error_expr(here());
  const Expr* target = conditional();
  std::optional<BinaryOp> op;
  if (panic_ || !assignment_operator(token().kind, &op)) return target;
  AssignExpr* result = make<AssignExpr>(here());
  advance();
  result->op = op;
  result->target = target;
  result->value = op.has_value() ? assignment() : assignment_value();
  return finish(result, {result->target, result->value});
}

const Expr* Parser::assignment_value() {
  return at(Kind::kLeftBrace) ? init_list() : assignment();
}

const Expr* Parser::conditional() {
  const Expr* condition = binary(1);
  if (panic_ || !at(Kind::kQuestion)) return condition;
  ConditionalExpr* result = make<ConditionalExpr>(here());
  advance();
  result->condition = condition;
  {
    Setting setting(greater_is_operator_, true);
    result->if_true = expression();
  }
  if (!panic_) expect(Kind::kColon, "':' of the conditional operator '?'");
  result->if_false = assignment();
  return finish(result, {condition, result->if_true, result->if_false});
}

const Expr* Parser::binary(int least_precedence) {
  const Expr* left = unary();
  while (!panic_) {
    BinaryOp op;
    const int precedence = precedence_here(&op);
    if (precedence < least_precedence) break;
    BinaryExpr* result = make<BinaryExpr>(here());
    advance();
    result->op = op;
    result->left = left;
    result->right = binary(precedence + 1);
    left = finish(result, {result->left, result->right});
  }
  return left;
}

int Parser::precedence_here(BinaryOp* op) const {
  const Kind kind = token().kind;
  const bool ends_template = kind == Kind::kGreater || kind == Kind::kGreaterGreater;
  if (ends_template && !greater_is_operator_) return 0;
  const BinaryInfo info = binary_info(kind);
  *op = info.op;
  return info.precedence;
}

const Expr* Parser::unary() {
  if (panic_) return error_expr(here());
  switch (token().kind) {
    case Kind::kPlus:
      return prefix_unary(UnaryOp::kPlus);
    case Kind::kMinus:
      return prefix_unary(UnaryOp::kMinus);
    case Kind::kExclaim:
      return prefix_unary(UnaryOp::kNot);
    case Kind::kTilde:
      return prefix_unary(UnaryOp::kComplement);
    case Kind::kPlusPlus:
      return prefix_unary(UnaryOp::kPreIncrement);
    case Kind::kMinusMinus:
      return prefix_unary(UnaryOp::kPreDecrement);
    case Kind::kSizeof:
      return size_of();
    case Kind::kLeftParen:
      return cast_or_parentheses();
    case Kind::kAmp:
    case Kind::kStar: {
      Nesting nesting(*this);
      if (!nesting.ok) return error_expr(here());
      report(DiagnosticId::kNoAddress, here(), {token().text});
      const SourceLocation location = here();
      advance();
      unary();
      return error_expr(location);
    }
    default:
      return postfix();
  }
}

const Expr* Parser::prefix_unary(UnaryOp op) {
  Nesting nesting(*this);
  if (!nesting.ok) return error_expr(here());
  UnaryExpr* result = make<UnaryExpr>(here());
  advance();
  result->op = op;
  result->operand = unary();
  return finish(result, {result->operand});
}

const Expr* Parser::cast_or_parentheses() {
  const size_t open = pos_;
  size_t end = behind_type(pos_ + 1);
  if (end != pos_ + 1) {
    while (token_at(end).is(Kind::kLeftBracket) && behind_closing(end) != end) {
      end = behind_closing(end);
    }
    const bool is_pointer = (token_at(end).is(Kind::kStar) || token_at(end).is(Kind::kAmp)) &&
                            token_at(end + 1).is(Kind::kRightParen);
    if (is_pointer) report(DiagnosticId::kNoPointers, token_at(end).location, {});
    if (is_pointer || token_at(end).is(Kind::kRightParen)) {
      Nesting nesting(*this);
      if (!nesting.ok) return error_expr(here());
      CastExpr* result = make<CastExpr>(here());
      advance();
      result->type = type_name();
      if (is_pointer) advance();
      expect_closing(Kind::kRightParen, open, "the type of the cast");
      result->operand = unary();
      return finish(result, {result->operand});
    }
  } else if (is_name(pos_ + 1) && token_at(pos_ + 2).is(Kind::kRightParen)) {
    // `(Unknown)x` cannot be an expression, whatever the name is.
    const Token& next = token_at(pos_ + 3);
    const bool is_operand =
        can_be_name(next.kind) || next.is(Kind::kIntLiteral) || next.is(Kind::kFloatLiteral);
    if (is_operand && (next.flags & Token::kAtLineStart) == 0) {
      report(DiagnosticId::kUnknownTypeName, token_at(pos_ + 1).location,
             {token_at(pos_ + 1).text});
      pos_ += 3;
      Nesting nesting(*this);
      if (!nesting.ok) return error_expr(here());
      unary();
      return error_expr(token_at(open).location);
    }
  }
  return postfix();
}

}  // namespace kaamos::hlsl
