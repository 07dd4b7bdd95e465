// SPDX-License-Identifier: MIT
// Macro expansion: recognising calls, reading arguments, the stack of tokens to be read next.
#include <utility>

#include "runtime/hlsl/front/preprocessor.h"

namespace kaamos::hlsl {
namespace {

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

}  // namespace

Token Preprocessor::stop_token(TokenKind kind) {
  Token token;
  token.kind = kind;
  if (!files_.empty()) token.location = lexer().location();
  return token;
}

// Macros whose frames have not been read to the end are not expanded [C++: cpp.rescan]. Their names
// are marked here, because they keep the mark after they leave the frame.
Token Preprocessor::next_unexpanded() {
  while (!frames_.empty()) {
    Frame& frame = frames_.back();
    if (frame.next < frame.tokens.size()) {
      Token token = frame.tokens[frame.next++];
      if (token.is(TokenKind::kIdentifier)) {
        const Macro* macro = identifiers_[token.value].macro;
        if (macro && macro->is_disabled) token.flags |= Token::kNoExpand;
      }
      return token;
    }
    if (frame.macro) frame.macro->is_disabled = false;
    frame.tokens.clear();
    spare_.push_back(std::move(frame.tokens));
    frames_.pop_back();
  }
  if (is_isolated_ || files_.empty()) return stop_token(TokenKind::kEndOfFile);
  return read_file_token();
}

Token Preprocessor::next_expanded() {
  for (;;) {
    Token token = next_unexpanded();
    if (!token.is(TokenKind::kIdentifier) || (token.flags & Token::kNoExpand)) return token;
    if (!identifiers_[token.value].macro) return token;
    bool is_replaced = false;
    if (!expand(token, is_replaced) || is_replaced) return token;
  }
}

bool Preprocessor::is_left_paren_next() {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    if (frame->next < frame->tokens.size()) {
      return frame->tokens[frame->next].is(TokenKind::kLeftParen);
    }
  }
  return !is_isolated_ && !files_.empty() && !is_fatal_ && !pending_ &&
         lexer().is_left_paren_next();
}

bool Preprocessor::expand(Token& token, bool& is_replaced) {
  Macro* macro = identifiers_[token.value].macro;
  if (macro->builtin != BuiltinMacro::kNone) {
    expand_builtin(token, *macro);
    is_replaced = true;
    return true;
  }
  if (macro->is_function_like && !is_left_paren_next()) return false;
  Call call{macro, token, 0, {}, {}};
  if (macro->is_function_like) {
    if (!read_arguments(call)) {
      // The tokens of the broken call are gone; reading continues after it.
      return true;
    }
  }
  if (is_fatal_ || !count_tokens(macro->body.size(), macro->name)) return true;
  call.expansion = sources_.begin_expansion(macro->name, token.location);
  Tokens result;
  if (!spare_.empty()) {
    result = std::move(spare_.back());
    spare_.pop_back();
  }
  substitute(call, 0, static_cast<uint32_t>(macro->body.size()), result);
  std::erase_if(result, [](const Token& t) { return t.is(TokenKind::kPlacemarker); });
  if (is_fatal_) return true;
  if (!result.empty()) {
    constexpr uint8_t kPlace = Token::kSpaceBefore | Token::kAtLineStart;
    result[0].flags = static_cast<uint8_t>((result[0].flags & ~kPlace) | (token.flags & kPlace));
  }
  macro->is_disabled = true;
  frames_.push_back({std::move(result), 0, macro});
  return true;
}

void Preprocessor::expand_builtin(Token& token, const Macro& macro) {
  ResolvedLocation at = sources_.resolve(token.location);
  token.kind = TokenKind::kNumber;
  if (macro.builtin == BuiltinMacro::kLine) {
    token.text = sources_.keep(std::to_string(at.line));
  } else if (macro.builtin == BuiltinMacro::kCounter) {
    token.text = sources_.keep(std::to_string(counter_++));
  } else {
    token.kind = TokenKind::kStringLiteral;
    token.text = sources_.keep(quoted(at.path));
  }
}

bool Preprocessor::count_tokens(size_t count, std::string_view macro) {
  expansion_tokens_ += count + 1;
  if (expansion_tokens_ <= options_.max_expansion_tokens) return true;
  if (!is_fatal_) {
    diagnostics_.report(DiagnosticId::kExpansionTooLarge,
                        files_.empty() ? SourceLocation{} : lexer().location(),
                        {std::to_string(options_.max_expansion_tokens), macro});
  }
  fatal();
  return false;
}

// Reads from `(` to the matching `)`. Returns false if that is missing or the number is wrong.
bool Preprocessor::read_arguments(Call& call) {
  const Macro& macro = *call.macro;
  collecting_.push_back(macro.name);
  Token open = next_unexpanded();
  call.arguments.emplace_back();
  uint32_t parens = 0;
  for (;;) {
    Token token = next_unexpanded();
    if (token.is(TokenKind::kEndOfFile) || token.is(TokenKind::kEndOfDirective)) {
      collecting_.pop_back();
      if (!is_fatal_) {
        diagnostics_.report(DiagnosticId::kUnterminatedArguments, call.name.location, {macro.name})
            .note(open.location, "the '(' is here");
      }
      return false;
    }
    if (token.is(TokenKind::kLeftParen)) ++parens;
    if (token.is(TokenKind::kRightParen) && parens-- == 0) break;
    bool is_rest = macro.is_variadic && call.arguments.size() == macro.parameters.size();
    if (token.is(TokenKind::kComma) && parens == 0 && !is_rest) {
      call.arguments.emplace_back();
      continue;
    }
    if (token.flags & Token::kAtLineStart) {
      token.flags =
          static_cast<uint8_t>((token.flags & ~Token::kAtLineStart) | Token::kSpaceBefore);
    }
    call.arguments.back().push_back(token);
  }
  collecting_.pop_back();
  return check_argument_count(call);
}

bool Preprocessor::check_argument_count(Call& call) {
  const Macro& macro = *call.macro;
  size_t wanted = macro.parameters.size();
  bool is_empty = call.arguments.size() == 1 && call.arguments[0].empty();
  if (wanted == 0 && is_empty) call.arguments.clear();
  size_t given = call.arguments.size();
  // The variadic part may be left out entirely, even its comma.
  if (macro.is_variadic && given + 1 == wanted) call.arguments.emplace_back();
  if (call.arguments.size() == wanted) {
    call.expanded.resize(wanted);
    return true;
  }
  std::string count =
      (macro.is_variadic ? "at least " + std::to_string(wanted - 1) : std::to_string(wanted));
  DiagnosticId id =
      given < wanted ? DiagnosticId::kTooFewArguments : DiagnosticId::kTooManyArguments;
  diagnostics_.report(id, call.name.location, {macro.name, count, std::to_string(given)})
      .note(macro.location, "macro '" + std::string(macro.name) + "' is defined here");
  return false;
}

}  // namespace kaamos::hlsl
