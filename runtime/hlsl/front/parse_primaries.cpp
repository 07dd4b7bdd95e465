// SPDX-License-Identifier: MIT
// Expressions from postfix operators down: members, calls, indices, names, literals, lists.
#include <algorithm>

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {

const Expr* Parser::postfix() {
  const Expr* base = primary();
  while (!panic_) {
    switch (token().kind) {
      case Kind::kArrow:
        report(DiagnosticId::kNoArrow, here(), {});
        base = member(base);
        break;
      case Kind::kDot:
        base = member(base);
        break;
      case Kind::kLeftBracket:
        base = index(base);
        break;
      case Kind::kLeftParen: {
        const bool is_callable = base->kind == ExprKind::kName || base->kind == ExprKind::kMember ||
                                 base->kind == ExprKind::kError;
        if (!is_callable) return base;
        CallExpr* call = make<CallExpr>(base->location);
        call->callee = base;
        call->arguments = call_arguments();
        base = finish(call, {base}, call->arguments);
        break;
      }
      case Kind::kPlusPlus:
      case Kind::kMinusMinus: {
        UnaryExpr* result = make<UnaryExpr>(here());
        result->op = at(Kind::kPlusPlus) ? UnaryOp::kPostIncrement : UnaryOp::kPostDecrement;
        result->operand = base;
        advance();
        base = finish(result, {result->operand});
        break;
      }
      default:
        return base;
    }
  }
  return base;
}

const Expr* Parser::member(const Expr* base) {
  advance();
  accept(Kind::kTemplate);  // `x.template f<T>()`
  if (!at_name()) {
    fail_here(DiagnosticId::kExpectedName, {"a member", describe(token())});
    return base;
  }
  MemberExpr* result = make<MemberExpr>(here());
  result->base = base;
  result->name = qualified_name(true);
  result->location = result->name->location;
  return finish(result, {base});
}

const Expr* Parser::index(const Expr* base) {
  const size_t open = pos_;
  IndexExpr* result = make<IndexExpr>(here());
  advance();
  Setting setting(greater_is_operator_, true);
  result->base = base;
  result->index = expression();
  expect_closing(Kind::kRightBracket, open, "the index");
  return finish(result, {result->base, result->index});
}

std::span<const Expr* const> Parser::call_arguments() {
  const size_t open = pos_;
  advance();
  if (accept(Kind::kRightParen)) return {};
  Setting setting(greater_is_operator_, true);
  std::vector<const Expr*> arguments;
  do {
    arguments.push_back(assignment());
  } while (!panic_ && accept(Kind::kComma));
  expect_list_end(Kind::kRightParen, open, "an argument");
  return list(arguments);
}

const Expr* Parser::primary() {
  if (panic_) return error_expr(here());
  const SourceLocation location = here();
  switch (token().kind) {
    case Kind::kIntLiteral:
    case Kind::kFloatLiteral:
      return number();
    case Kind::kStringLiteral: {
      StringLiteralExpr* result = make<StringLiteralExpr>(location);
      result->value = token().text;
      advance();
      return result;
    }
    case Kind::kTrue:
    case Kind::kFalse: {
      BoolLiteralExpr* result = make<BoolLiteralExpr>(location);
      result->value = at(Kind::kTrue);
      advance();
      return result;
    }
    case Kind::kThis:
      advance();
      return make<ThisExpr>(location);
    case Kind::kLeftParen: {
      const size_t open = pos_;
      advance();
      Setting setting(greater_is_operator_, true);
      const Expr* inner = expression();
      expect_closing(Kind::kRightParen, open, "the expression");
      // Nodes are constant for everyone who receives them, but this one was only just made.
      const_cast<Expr*>(inner)->is_parenthesized = true;
      return inner;
    }
    case Kind::kLeftBrace:
      report(DiagnosticId::kInitListNotHere, location, {});
      init_list();
      return error_expr(location);
    case Kind::kLeftBracket:
      fail_here(DiagnosticId::kNoLambda, {});
      return error_expr(location);
    case Kind::kReservedWord:
      return reserved_expression();
    case Kind::kVoid:
    case Kind::kUnsigned:
    case Kind::kTypename: {
      const size_t begin = pos_;
      const TypeSyntax* type = type_name();
      if (at(Kind::kLeftParen)) return construct(type);
      fail(DiagnosticId::kTypeInExpression, location, {text_between(begin, pos_)});
      return error_expr(location);
    }
    default:
      break;
  }
  if (at_name() || at(Kind::kColonColon)) return name_or_construct();
  if (is_keyword(token().kind)) return keyword_expression();
  fail_here(DiagnosticId::kExpectedExpression, {describe(token())});
  return error_expr(location);
}

const Expr* Parser::number() {
  const Token& literal = token();
  NumberLiteral value;
  if (literal.value < source_.numbers.size()) value = source_.number(literal);
  advance();
  if (literal.is(Kind::kIntLiteral)) {
    IntLiteralExpr* result = make<IntLiteralExpr>(literal.location);
    result->value = value.integer;
    result->suffix = value.suffix;
    result->is_decimal = value.is_decimal;
    return result;
  }
  FloatLiteralExpr* result = make<FloatLiteralExpr>(literal.location);
  result->value = value.real;
  result->suffix = value.suffix;
  return result;
}

const Expr* Parser::name_or_construct() {
  const size_t begin = pos_;
  const NameLookup name = look_up(pos_);
  if (name.is_type()) {
    const TypeSyntax* type = type_without_bounds();
    if (panic_) return error_expr(here());
    if (at(Kind::kLeftParen)) return construct(type);
    const std::string text = text_between(begin, pos_);
    const bool is_brace = at(Kind::kLeftBrace);
    fail(is_brace ? DiagnosticId::kNoBraceConstruction : DiagnosticId::kTypeInExpression,
         token_at(begin).location, {text});
    return error_expr(token_at(begin).location);
  }
  NameExpr* result = make<NameExpr>(here());
  result->name = qualified_name(false);
  result->location = result->name->location;
  return result;
}

const Expr* Parser::construct(const TypeSyntax* type) {
  ConstructExpr* result = make<ConstructExpr>(type->location);
  result->type = type;
  result->arguments = call_arguments();
  return finish(result, {}, result->arguments);
}

const Expr* Parser::size_of() {
  Nesting nesting(*this);
  if (!nesting.ok) return error_expr(here());
  SizeofExpr* result = make<SizeofExpr>(here());
  advance();
  const size_t end = at(Kind::kLeftParen) ? behind_type(pos_ + 1) : pos_;
  const bool is_type =
      at(Kind::kLeftParen) && end != pos_ + 1 &&
      (token_at(end).is(Kind::kRightParen) || token_at(end).is(Kind::kLeftBracket));
  if (!is_type) {
    result->operand = unary();
    return finish(result, {result->operand});
  }
  const size_t open = pos_;
  advance();
  result->type = type_name();
  expect_closing(Kind::kRightParen, open, "the type of sizeof");
  return finish(result, {});
}

const Expr* Parser::reserved_expression() {
  const SourceLocation location = here();
  const std::string_view word = token().text;
  if (word == "new" || word == "delete") {
    fail_here(DiagnosticId::kNoDynamicMemory, {word});
  } else if (word == "throw" || word == "try" || word == "catch") {
    fail_here(DiagnosticId::kNoExceptions, {word});
  } else if (word.ends_with("_cast")) {
    fail_here(DiagnosticId::kNoCppCast, {word});
  } else if (word == "long" || word == "short" || word == "char" || word == "signed" ||
             word == "auto") {
    const TypeSyntax* type = type_without_bounds();
    return at(Kind::kLeftParen) ? construct(type) : error_expr(location);
  } else {
    fail_here(DiagnosticId::kReservedWord, {word});
  }
  return error_expr(location);
}

// A keyword whose declaration as a name was refused has had its message.
const Expr* Parser::keyword_expression() {
  const bool is_refused = std::find(refused_names_.begin(), refused_names_.end(), token().value) !=
                          refused_names_.end();
  if (is_refused) {
    panic_ = true;
  } else {
    fail_here(DiagnosticId::kKeywordInExpression, {token().text});
  }
  return error_expr(here());
}

const Expr* Parser::init_list() {
  const size_t open = pos_;
  InitListExpr* result = make<InitListExpr>(here());
  advance();
  Nesting nesting(*this);
  if (!nesting.ok) return error_expr(result->location);
  Setting setting(greater_is_operator_, true);
  std::vector<const Expr*> elements;
  while (!panic_ && !at(Kind::kRightBrace)) {
    elements.push_back(assignment_value());
    if (!accept(Kind::kComma)) break;
  }
  expect_list_end(Kind::kRightBrace, open, "an element of the list");
  result->elements = list(elements);
  return finish(result, {}, result->elements);
}

}  // namespace kaamos::hlsl
