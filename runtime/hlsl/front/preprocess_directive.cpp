// SPDX-License-Identifier: MIT
// Directives other than #define, #include and the conditionals.
#include <array>

#include "runtime/hlsl/front/preprocessor.h"

namespace kaamos::hlsl {
namespace {

// Known in other compilers, but without meaning here.
constexpr std::array<std::string_view, 9> kIgnoredPragmas = {
    "warning", "message", "region", "endregion", "clang", "GCC", "dxc", "def", "kaamos"};

}  // namespace

void Preprocessor::read_directive(const Token& hash) {
  lexer().begin_directive();
  Token name = lexer().next();
  run_directive(hash, name);
}

void Preprocessor::run_directive(const Token& hash, const Token& name) {
  std::string_view text = name.text;
  if (name.is(TokenKind::kEndOfDirective)) return finish_directive();
  if (name.is(TokenKind::kNumber)) return directive_line("line", name);
  if (text == "include" && !collecting_.empty()) {
    diagnostics_.report(DiagnosticId::kIncludeInArguments, name.location,
                        {text, collecting_.back()});
    return finish_directive();
  }
  if (text == "define") return directive_define();
  if (text == "include") return directive_include(name);
  if (text == "if") return directive_if(name, read_condition(name));
  if (text == "ifdef" || text == "ifndef") return directive_if(name, read_ifdef(name));
  if (text == "elif") return directive_elif(name);
  if (text == "else") return directive_else(name);
  if (text == "endif") return directive_endif(name);
  if (text == "undef") return directive_undef();
  if (text == "line") return directive_line("line", std::nullopt);
  if (text == "error") return directive_message(name, DiagnosticId::kErrorDirective);
  if (text == "warning") return directive_message(name, DiagnosticId::kWarningDirective);
  if (text == "pragma") return directive_pragma(hash);
  diagnostics_.report(DiagnosticId::kUnknownDirective, name.location, {text});
  finish_directive();
}

void Preprocessor::expect_end(std::string_view directive) {
  Token token = next_unexpanded();
  if (!token.is(TokenKind::kEndOfDirective) && !token.is(TokenKind::kEndOfFile)) {
    diagnostics_.report(DiagnosticId::kExtraTokens, token.location, {directive, describe(token)});
  }
  finish_directive();
}

// Skips the rest of the line, and of any macros being expanded in it.
void Preprocessor::finish_directive() {
  for (Frame& frame : frames_) {
    if (frame.macro) frame.macro->is_disabled = false;
  }
  frames_.clear();
  if (files_.empty()) return;
  while (!lexer().next().is(TokenKind::kEndOfDirective)) {
  }
  lexer().end_directive();
}

std::optional<Token> Preprocessor::read_macro_name(std::string_view directive) {
  Token name = lexer().next();
  if (!name.is(TokenKind::kIdentifier)) {
    diagnostics_.report(DiagnosticId::kMacroNameExpected, name.location,
                        {directive, describe(name)});
    return std::nullopt;
  }
  if (name.value == defined_) {
    diagnostics_.report(DiagnosticId::kMacroNameDefined, name.location);
    return std::nullopt;
  }
  return name;
}

void Preprocessor::directive_undef() {
  std::optional<Token> name = read_macro_name("undef");
  if (!name) return finish_directive();
  Macro*& macro = identifiers_[name->value].macro;
  if (macro && macro->is_predefined) {
    diagnostics_.report(DiagnosticId::kBuiltinMacroChanged, name->location, {"undef", name->text});
  }
  macro = nullptr;
  expect_end("undef");
}

void Preprocessor::directive_line(std::string_view name, std::optional<Token> number) {
  bool is_marker = number.has_value();
  Token line = is_marker ? *number : next_expanded();
  uint64_t value = 0;
  bool is_valid = line.is(TokenKind::kNumber) && line.text.size() <= 10;
  for (char c : line.text) {
    is_valid = is_valid && c >= '0' && c <= '9';
    value = value * 10 + static_cast<uint64_t>(c - '0');
  }
  if (!is_valid || value > 2147483647) {
    diagnostics_.report(DiagnosticId::kLineNumberExpected, line.location, {describe(line)});
    return finish_directive();
  }
  Token path = next_expanded();
  std::optional<std::string> shown;
  bool is_empty = path.text == "\"\"";
  if (path.is(TokenKind::kStringLiteral) && !is_empty) {
    shown = parse_quoted(path.text, path.location, diagnostics_);
  } else if (!path.is(TokenKind::kEndOfDirective)) {
    diagnostics_.report(DiagnosticId::kLineNameExpected, path.location, {describe(path)});
    return finish_directive();
  }
  SourceManager::FileIndex index = lexer().file();
  uint32_t offset = lexer().offset();
  // `# 1 "file" 1 3`: the flags in preprocessor output have no meaning here.
  if (is_marker || !shown) {
    finish_directive();
  } else {
    expect_end(name);
  }
  sources_.set_line(index, offset, static_cast<uint32_t>(value), std::move(shown));
}

void Preprocessor::directive_message(const Token& name, DiagnosticId id) {
  diagnostics_.report(id, name.location, {lexer().rest_of_line()});
  finish_directive();
}

void Preprocessor::directive_pragma(const Token& hash) {
  Token name = lexer().next();
  if (name.text == "once") {
    once_.insert(file().text);
    if (files_.size() == 1) {
      diagnostics_.report(DiagnosticId::kPragmaOnceInMainFile, name.location);
    }
    return expect_end("pragma once");
  }
  if (name.text == "pack_matrix") return pragma_pack_matrix(hash, name);
  bool is_known = false;
  for (std::string_view known : kIgnoredPragmas) is_known = is_known || name.text == known;
  if (!is_known && !name.is(TokenKind::kEndOfDirective)) {
    diagnostics_.report(DiagnosticId::kUnknownPragma, name.location, {describe(name)});
  }
  finish_directive();
}

void Preprocessor::pragma_pack_matrix(const Token& hash, const Token& name) {
  Token open = next_expanded();
  Token order = open.is(TokenKind::kLeftParen) ? next_expanded() : open;
  bool is_order = order.text == "row_major" || order.text == "column_major";
  Token close = open.is(TokenKind::kLeftParen) && is_order ? next_expanded() : order;
  if (!close.is(TokenKind::kRightParen)) {
    diagnostics_.report(DiagnosticId::kPackMatrixMalformed, close.location, {describe(close)});
    return finish_directive();
  }
  expect_end("pragma pack_matrix");
  Token token = hash;
  token.kind = TokenKind::kPragmaPackMatrix;
  token.location = name.location;
  token.text = order.text;
  pending_ = token;
}

}  // namespace kaamos::hlsl
