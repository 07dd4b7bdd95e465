// SPDX-License-Identifier: MIT
// The expression of #if and #elif [C++: cpp.cond]: 64-bit integers, all operators except assignment
// and comma.
#include "runtime/hlsl/front/preprocessor.h"

namespace kaamos::hlsl {
namespace {

constexpr uint32_t kMaxDepth = 512;

struct Value {
  uint64_t bits = 0;
  bool is_unsigned = false;

  int64_t as_signed() const { return static_cast<int64_t>(bits); }
};

int precedence(TokenKind kind) {
  switch (kind) {
    case TokenKind::kStar:
    case TokenKind::kSlash:
    case TokenKind::kPercent:
      return 10;
    case TokenKind::kPlus:
    case TokenKind::kMinus:
      return 9;
    case TokenKind::kLessLess:
    case TokenKind::kGreaterGreater:
      return 8;
    case TokenKind::kLess:
    case TokenKind::kLessEqual:
    case TokenKind::kGreater:
    case TokenKind::kGreaterEqual:
      return 7;
    case TokenKind::kEqualEqual:
    case TokenKind::kExclaimEqual:
      return 6;
    case TokenKind::kAmp:
      return 5;
    case TokenKind::kCaret:
      return 4;
    case TokenKind::kPipe:
      return 3;
    case TokenKind::kAmpAmp:
      return 2;
    case TokenKind::kPipePipe:
      return 1;
    default:
      return 0;
  }
}

// A negative count shifts the other way; once all bits are shifted out, zeros or copies of the sign
// remain.
Value shift(Value value, Value count, bool is_left) {
  bool is_negative = !count.is_unsigned && count.as_signed() < 0;
  uint64_t distance = is_negative ? 0 - count.bits : count.bits;
  if (is_negative) is_left = !is_left;
  bool is_sign_filled = !value.is_unsigned && value.as_signed() < 0;
  if (is_left) {
    value.bits = distance > 63 ? 0 : value.bits << distance;
  } else if (distance > 63) {
    value.bits = is_sign_filled ? ~uint64_t{0} : 0;
  } else {
    uint64_t fill = is_sign_filled && distance > 0 ? ~uint64_t{0} << (64 - distance) : 0;
    value.bits = (value.bits >> distance) | fill;
  }
  return value;
}

bool is_less(Value a, Value b) {
  return a.is_unsigned || b.is_unsigned ? a.bits < b.bits : a.as_signed() < b.as_signed();
}

class ConditionParser {
 public:
  ConditionParser(Preprocessor& preprocessor, std::string_view directive)
      : preprocessor_(preprocessor),
        directive_(directive),
        errors_before_(preprocessor.diagnostics().error_count()) {}

  bool parse(SourceLocation directive_location) {
    advance();
    if (token_.is(TokenKind::kEndOfDirective)) {
      report(DiagnosticId::kConditionExpected, directive_location, {directive_});
      return false;
    }
    Value value = conditional();
    if (!failed_ && !at_end()) {
      report(DiagnosticId::kConditionTrailing, token_.location, {directive_, describe(token_)});
    }
    return !failed_ && value.bits != 0;
  }

 private:
  bool at_end() const {
    return token_.is(TokenKind::kEndOfDirective) || token_.is(TokenKind::kEndOfFile);
  }
  void advance() { token_ = preprocessor_.next_expanded(); }

  // Only the first error is reported, even if it came from a macro call; the rest of the expression
  // is not read.
  void report(DiagnosticId id, SourceLocation location,
              std::initializer_list<std::string_view> arguments) {
    bool is_first = !failed_ && !preprocessor_.is_fatal() &&
                    preprocessor_.diagnostics().error_count() == errors_before_;
    if (is_first) preprocessor_.diagnostics().report(id, location, arguments);
    failed_ = true;
  }

  void expect(TokenKind kind) {
    if (token_.is(kind)) return advance();
    report(DiagnosticId::kConditionTokenExpected, token_.location,
           {"'" + std::string(token_kind_text(kind)) + "'", describe(token_)});
  }

  bool enter() {
    if (++depth_ <= kMaxDepth) return true;
    report(DiagnosticId::kConditionTooDeep, token_.location,
           {directive_, std::to_string(kMaxDepth)});
    return false;
  }

  Value conditional() {
    if (!enter()) return {};
    Value condition = binary(1);
    if (!failed_ && token_.is(TokenKind::kQuestion)) {
      advance();
      bool was_evaluated = evaluate_;
      evaluate_ = was_evaluated && condition.bits != 0;
      Value if_true = conditional();
      if (!failed_) expect(TokenKind::kColon);
      evaluate_ = was_evaluated && condition.bits == 0;
      Value if_false = failed_ ? Value{} : conditional();
      evaluate_ = was_evaluated;
      bool is_unsigned = if_true.is_unsigned || if_false.is_unsigned;
      condition = condition.bits ? if_true : if_false;
      condition.is_unsigned = is_unsigned;
    }
    --depth_;
    return condition;
  }

  Value binary(int minimum) {
    Value left = unary();
    while (!failed_) {
      Token operation = token_;
      int level = precedence(operation.kind);
      if (level == 0 || level < minimum) break;
      advance();
      bool was_evaluated = evaluate_;
      if (operation.is(TokenKind::kAmpAmp)) evaluate_ = evaluate_ && left.bits != 0;
      if (operation.is(TokenKind::kPipePipe)) evaluate_ = evaluate_ && left.bits == 0;
      Value right = binary(level + 1);
      evaluate_ = was_evaluated;
      if (!failed_) left = apply(operation, left, right);
    }
    return left;
  }

  Value apply(const Token& operation, Value a, Value b) {
    bool is_unsigned = a.is_unsigned || b.is_unsigned;
    auto boolean = [](bool value) { return Value{value, false}; };
    switch (operation.kind) {
      case TokenKind::kStar:
        return {a.bits * b.bits, is_unsigned};
      case TokenKind::kSlash:
      case TokenKind::kPercent:
        return divide(operation, a, b, is_unsigned);
      case TokenKind::kPlus:
        return {a.bits + b.bits, is_unsigned};
      case TokenKind::kMinus:
        return {a.bits - b.bits, is_unsigned};
      case TokenKind::kLessLess:
        return shift(a, b, true);
      case TokenKind::kGreaterGreater:
        return shift(a, b, false);
      case TokenKind::kLess:
        return boolean(is_less(a, b));
      case TokenKind::kLessEqual:
        return boolean(!is_less(b, a));
      case TokenKind::kGreater:
        return boolean(is_less(b, a));
      case TokenKind::kGreaterEqual:
        return boolean(!is_less(a, b));
      case TokenKind::kEqualEqual:
        return boolean(a.bits == b.bits);
      case TokenKind::kExclaimEqual:
        return boolean(a.bits != b.bits);
      case TokenKind::kAmp:
        return {a.bits & b.bits, is_unsigned};
      case TokenKind::kCaret:
        return {a.bits ^ b.bits, is_unsigned};
      case TokenKind::kPipe:
        return {a.bits | b.bits, is_unsigned};
      case TokenKind::kAmpAmp:
        return boolean(a.bits && b.bits);
      default:
        return boolean(a.bits || b.bits);
    }
  }

  Value divide(const Token& operation, Value a, Value b, bool is_unsigned) {
    bool is_quotient = operation.is(TokenKind::kSlash);
    if (b.bits == 0) {
      if (evaluate_) {
        report(DiagnosticId::kConditionDivisionByZero, operation.location, {directive_});
      }
      return {0, is_unsigned};
    }
    if (is_unsigned) return {is_quotient ? a.bits / b.bits : a.bits % b.bits, true};
    // The smallest number divided by -1 does not fit and wraps around.
    if (b.as_signed() == -1) return {is_quotient ? 0 - a.bits : 0, false};
    int64_t result = is_quotient ? a.as_signed() / b.as_signed() : a.as_signed() % b.as_signed();
    return {static_cast<uint64_t>(result), false};
  }

  Value unary() {
    if (!enter()) return {};
    Value value = unary_inner();
    --depth_;
    return value;
  }

  Value unary_inner() {
    Token token = token_;
    switch (token.kind) {
      case TokenKind::kPlus:
        advance();
        return unary();
      case TokenKind::kMinus: {
        advance();
        Value value = unary();
        return {0 - value.bits, value.is_unsigned};
      }
      case TokenKind::kTilde: {
        advance();
        Value value = unary();
        return {~value.bits, value.is_unsigned};
      }
      case TokenKind::kExclaim:
        advance();
        return {unary().bits == 0, false};
      case TokenKind::kLeftParen: {
        advance();
        Value value = conditional();
        if (!failed_) expect(TokenKind::kRightParen);
        return value;
      }
      case TokenKind::kNumber:
        return number();
      case TokenKind::kCharacter: {
        std::string text = parse_quoted(token.text, token.location, preprocessor_.diagnostics());
        advance();
        if (text.empty()) report(DiagnosticId::kEmptyCharacter, token.location, {});
        return {text.empty() ? 0 : static_cast<uint64_t>(static_cast<int64_t>(text.back())), false};
      }
      case TokenKind::kIdentifier:
        return name();
      default:
        report(DiagnosticId::kConditionOperandExpected, token.location,
               {directive_, describe(token)});
        return {};
    }
  }

  Value number() {
    NumberLiteral literal = parse_number(token_.text, token_.location, preprocessor_.diagnostics());
    if (preprocessor_.diagnostics().error_count() != errors_before_) failed_ = true;
    if (literal.is_float) {
      report(DiagnosticId::kConditionFloat, token_.location, {token_.text, directive_});
    }
    if (!failed_) advance();
    bool is_unsigned = literal.suffix == LiteralSuffix::kU ||
                       literal.suffix == LiteralSuffix::kUL || literal.integer > INT64_MAX;
    return {literal.integer, is_unsigned};
  }

  // A name that is not a macro is 0; `true` is 1, as in C++.
  Value name() {
    if (token_.text == "defined") return defined();
    Value value{token_.text == "true", false};
    if (token_.text == "__has_include") value.bits = preprocessor_.has_include(token_);
    advance();
    return value;
  }

  Value defined() {
    Token operand = preprocessor_.next_unexpanded();
    bool has_paren = operand.is(TokenKind::kLeftParen);
    if (has_paren) operand = preprocessor_.next_unexpanded();
    if (!operand.is(TokenKind::kIdentifier)) {
      report(DiagnosticId::kMacroNameExpected, operand.location, {"if defined", describe(operand)});
      return {};
    }
    bool is_set = preprocessor_.is_defined(operand);
    advance();
    if (has_paren) expect(TokenKind::kRightParen);
    return {is_set, false};
  }

  Preprocessor& preprocessor_;
  std::string_view directive_;
  uint32_t errors_before_;
  Token token_;
  uint32_t depth_ = 0;
  bool failed_ = false;
  bool evaluate_ = true;
};

}  // namespace

bool Preprocessor::read_condition(const Token& name) {
  bool value = ConditionParser(*this, name.text).parse(name.location);
  finish_directive();
  return value;
}

}  // namespace kaamos::hlsl
