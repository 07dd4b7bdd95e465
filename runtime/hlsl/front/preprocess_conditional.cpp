// SPDX-License-Identifier: MIT
// #if, #ifdef, #ifndef, #elif, #else, #endif and the groups that they skip.
#include "runtime/hlsl/front/preprocessor.h"

namespace kaamos::hlsl {

bool Preprocessor::is_defined(const Token& name) {
  return name.value == has_include_ || identifiers_[name.value].macro != nullptr;
}

bool Preprocessor::read_ifdef(const Token& name) {
  Token macro = lexer().next();
  if (!macro.is(TokenKind::kIdentifier)) {
    diagnostics_.report(DiagnosticId::kMacroNameExpected, macro.location,
                        {name.text, describe(macro)});
    finish_directive();
    return false;
  }
  bool is_set = is_defined(macro);
  expect_end(name.text);
  return name.text == "ifdef" ? is_set : !is_set;
}

void Preprocessor::directive_if(const Token& name, bool value) {
  file().conditionals.push_back({name.location, name.text, value, false});
  if (!value) skip_group();
}

// A group that was read ends here; all others up to #endif are skipped.
void Preprocessor::directive_elif(const Token& name) {
  if (file().conditionals.empty()) {
    diagnostics_.report(DiagnosticId::kConditionalWithoutIf, name.location, {name.text});
    return finish_directive();
  }
  if (file().conditionals.back().has_else) {
    diagnostics_.report(DiagnosticId::kElseAfterElse, name.location, {name.text});
  }
  finish_directive();
  skip_group();
}

void Preprocessor::directive_else(const Token& name) {
  if (file().conditionals.empty()) {
    diagnostics_.report(DiagnosticId::kConditionalWithoutIf, name.location, {name.text});
    return finish_directive();
  }
  Conditional& conditional = file().conditionals.back();
  if (conditional.has_else) {
    diagnostics_.report(DiagnosticId::kElseAfterElse, name.location, {name.text});
  }
  conditional.has_else = true;
  expect_end("else");
  skip_group();
}

void Preprocessor::directive_endif(const Token& name) {
  if (file().conditionals.empty()) {
    diagnostics_.report(DiagnosticId::kConditionalWithoutIf, name.location, {name.text});
    return finish_directive();
  }
  file().conditionals.pop_back();
  expect_end("endif");
}

void Preprocessor::skip_group() {
  uint32_t depth = 0;
  for (;;) {
    lexer().set_skipping(true);
    Token token = lexer().next();
    while (!token.is(TokenKind::kEndOfFile) &&
           !(token.is(TokenKind::kHash) && (token.flags & Token::kAtLineStart))) {
      token = lexer().next();
    }
    lexer().set_skipping(false);
    if (token.is(TokenKind::kEndOfFile)) return;  // leave_file() reports it.
    lexer().begin_directive();
    if (skip_directive(depth)) return;
    if (is_fatal_ || diagnostics_.should_stop()) return;
  }
}

bool Preprocessor::skip_directive(uint32_t& depth) {
  Token name = lexer().next();
  std::string_view text = name.text;
  if (text == "if" || text == "ifdef" || text == "ifndef") ++depth;
  bool is_ours = depth == 0 && (text == "elif" || text == "else" || text == "endif");
  if (!is_ours) {
    if (text == "endif" && depth > 0) --depth;
    finish_directive();
    return false;
  }
  if (text == "endif") {
    directive_endif(name);
    return true;
  }
  Conditional& conditional = file().conditionals.back();
  if (conditional.has_else) {
    diagnostics_.report(DiagnosticId::kElseAfterElse, name.location, {text});
    finish_directive();
    return false;
  }
  if (text == "else") {
    conditional.has_else = true;
    expect_end("else");
  } else if (conditional.is_taken) {
    finish_directive();
  }
  if (conditional.is_taken) return false;
  // The keyword stays "if", because errors point at the #if.
  conditional.is_taken = text == "else" || read_condition(name);
  return conditional.is_taken;
}

}  // namespace kaamos::hlsl
