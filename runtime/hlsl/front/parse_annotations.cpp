// SPDX-License-Identifier: MIT
// Parses what comes after a colon: semantics, registers, packoffset, payload access qualifiers.
#include <cctype>
#include <charconv>

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool all_digits(std::string_view text) {
  for (char c : text) {
    if (!is_digit(c)) return false;
  }
  return !text.empty();
}

// `ps_5_0`, `vs`: for registers of one profile.
bool is_profile(std::string_view text) {
  return text.size() >= 2 && text[1] == 's' && (text.size() == 2 || text[2] == '_');
}

}  // namespace

Annotations Parser::annotations() {
  Annotations result;
  if (!at(Kind::kColon)) return result;
  std::vector<RegisterBinding> registers;
  std::vector<PayloadAccess> payload;
  while (!panic_ && accept(Kind::kColon)) one_annotation(result, registers, payload);
  result.registers = list(registers);
  result.payload_access = list(payload);
  return result;
}

void Parser::one_annotation(Annotations& result, std::vector<RegisterBinding>& registers,
                            std::vector<PayloadAccess>& payload) {
  if (at(Kind::kRegister)) return register_binding(registers);
  if (at(Kind::kPackOffset)) return pack_offset(result);
  if (at(Kind::kIntLiteral)) {
    fail_here(DiagnosticId::kBitFieldPlace, {});
    return;
  }
  const bool is_access = at_name() && (token().text == "read" || token().text == "write") &&
                         peek(1).is(Kind::kLeftParen);
  if (is_access) return payload_access(payload);
  semantic(result);
}

void Parser::semantic(Annotations& result) {
  const Token* name = expect_name("a semantic, a register or an access qualifier");
  if (name == nullptr) return;
  // The first one counts. [DXC]
  if (result.semantic != nullptr) {
    report(DiagnosticId::kSemanticIgnored, name->location, {name->text, result.semantic->text});
    return;
  }
  Semantic* semantic = make<Semantic>(name->location);
  semantic->text = name->text;
  size_t digits = name->text.size();
  while (digits > 1 && is_digit(name->text[digits - 1])) --digits;
  semantic->base = name->text.substr(0, digits);
  if (digits < name->text.size()) {
    parse_number(name->text.substr(digits), &semantic->index, *name);
  }
  result.semantic = semantic;
}

bool Parser::parse_number(std::string_view digits, uint32_t* value, const Token& token) {
  const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), *value);
  if (parsed.ec == std::errc()) return true;
  *value = 0;
  report(DiagnosticId::kRegisterTooLarge, token.location, {token.text});
  return false;
}

void Parser::register_binding(std::vector<RegisterBinding>& out) {
  advance();
  const size_t open = pos_;
  if (!expect(Kind::kLeftParen, "'(' after 'register'")) return;
  RegisterBinding result{.location = here()};
  if (at_name() && is_profile(token().text) && peek(1).is(Kind::kComma)) {
    advance();
    advance();
  }
  const Token& first = token();
  const bool is_space = first.text.starts_with("space") && all_digits(first.text.substr(5));
  if (!at_name()) {
    fail_here(DiagnosticId::kRegisterExpected, {describe(first)});
    return;
  }
  if (!is_space) {
    const char letter = static_cast<char>(std::tolower(static_cast<unsigned char>(first.text[0])));
    const bool is_class = std::string_view("tubsci").find(letter) != std::string_view::npos;
    const bool is_numbered = all_digits(first.text.substr(1)) ||
                             (first.text.size() == 1 && peek(1).is(Kind::kLeftBracket));
    if (!is_class || !is_numbered) {
      fail_here(DiagnosticId::kRegisterExpected, {describe(first)});
      return;
    }
    result.location = first.location;
    result.register_class = letter;
    if (first.text.size() > 1) parse_number(first.text.substr(1), &result.number, first);
    advance();
    result.number += element_offset();
    if (panic_) return;
  }
  if (is_space || accept(Kind::kComma)) {
    const Token& space = token();
    const bool is_valid =
        at_name() && space.text.starts_with("space") && all_digits(space.text.substr(5));
    if (!is_valid) {
      fail_here(DiagnosticId::kRegisterSpaceExpected, {describe(space)});
      return;
    }
    result.has_space = true;
    parse_number(space.text.substr(5), &result.space, space);
    advance();
  }
  expect_closing(Kind::kRightParen, open, "the register");
  out.push_back(result);
}

// `[1]` in `register(t0[1])`, which adds to the number.
uint32_t Parser::element_offset() {
  if (!at(Kind::kLeftBracket)) return 0;
  const size_t open = pos_;
  advance();
  uint32_t result = 0;
  const Token& number = token();
  if (expect(Kind::kIntLiteral, "a number")) {
    parse_number(number.text, &result, number);
    expect_closing(Kind::kRightBracket, open, "the number");
  }
  return result;
}

void Parser::pack_offset(Annotations& result) {
  const Token& keyword = token();
  advance();
  const size_t open = pos_;
  if (!expect(Kind::kLeftParen, "'(' after 'packoffset'")) return;
  const Token& constant = token();
  const bool is_register = at_name() && (constant.text[0] == 'c' || constant.text[0] == 'C') &&
                           (all_digits(constant.text.substr(1)) ||
                            (constant.text.size() == 1 && peek(1).is(Kind::kLeftBracket)));
  if (!is_register) {
    fail_here(DiagnosticId::kPackOffsetExpected, {describe(constant)});
    return;
  }
  if (result.pack_offset != nullptr) {
    report(DiagnosticId::kAnnotationTwice, keyword.location, {"packoffset"});
  }
  PackOffset* offset = make<PackOffset>(constant.location);
  if (constant.text.size() > 1) {
    parse_number(constant.text.substr(1), &offset->register_index, constant);
  }
  advance();
  offset->register_index += element_offset();
  if (panic_) return;
  if (accept(Kind::kDot)) {
    const std::string_view text = token().text;
    const size_t xyzw = text.size() == 1 ? std::string_view("xyzw").find(text[0]) : 4;
    const size_t rgba = text.size() == 1 ? std::string_view("rgba").find(text[0]) : 4;
    if (!at_name() || (xyzw >= 4 && rgba >= 4)) {
      fail_here(DiagnosticId::kPackOffsetExpected, {describe(token())});
      return;
    }
    offset->component = static_cast<uint32_t>(xyzw < 4 ? xyzw : rgba);
    advance();
  }
  expect_closing(Kind::kRightParen, open, "the offset");
  result.pack_offset = offset;
}

void Parser::payload_access(std::vector<PayloadAccess>& out) {
  PayloadAccess result{.location = here(), .is_write = token().text == "write", .stages = {}};
  advance();
  const size_t open = pos_;
  advance();
  std::vector<PayloadStage> stages;
  while (!panic_ && !at(Kind::kRightParen)) {
    const Token* name = expect_name("a shader stage");
    if (name == nullptr) return;
    stages.push_back({name->location, name->text});
    if (!accept(Kind::kComma)) break;
  }
  expect_list_end(Kind::kRightParen, open, "a shader stage");
  result.stages = list(stages);
  out.push_back(result);
}

}  // namespace kaamos::hlsl
