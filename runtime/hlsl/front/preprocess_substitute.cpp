// SPDX-License-Identifier: MIT
// A macro's body with its arguments inserted: #, ##, __VA_OPT__ [C++: cpp.subst, cpp.concat].
#include <utility>

#include "runtime/hlsl/front/preprocessor.h"

namespace kaamos::hlsl {
namespace {

Token placemarker(const Token& at) {
  Token token = at;
  token.kind = TokenKind::kPlacemarker;
  token.text = {};
  return token;
}

void copy_space(Token& to, const Token& from) {
  to.flags =
      static_cast<uint8_t>((to.flags & ~Token::kSpaceBefore) | (from.flags & Token::kSpaceBefore));
}

}  // namespace

void Preprocessor::substitute(Call& call, uint32_t begin, uint32_t end, Tokens& result) {
  const std::vector<MacroItem>& body = call.macro->body;
  for (uint32_t i = begin; i < end && !is_fatal_; ++i) {
    if (body[i].role != MacroItem::kPaste) {
      uint32_t behind = body[i].role == MacroItem::kVaOptBegin ? body[i].end + 1 : i + 1;
      bool is_pasted = behind < end && body[behind].role == MacroItem::kPaste;
      i = append_operand(call, i, is_pasted, result);
      continue;
    }
    const MacroItem& right = body[i + 1];
    bool is_variadic_parameter = right.role == MacroItem::kParameter && call.macro->is_variadic &&
                                 right.parameter + 1 == call.macro->parameters.size();
    // `, ## __VA_ARGS__`: the comma is dropped if there are no arguments [GNU].
    if (is_variadic_parameter && i > begin && body[i - 1].token.is(TokenKind::kComma) &&
        body[i - 1].role == MacroItem::kPlain) {
      if (call.arguments[right.parameter].empty()) {
        result.pop_back();
        result.push_back(placemarker(right.token));
        ++i;
      } else {
        i = append_operand(call, i + 1, false, result);
      }
      continue;
    }
    Tokens operand;
    uint32_t operation = i;
    i = append_operand(call, i + 1, true, operand);
    if (!is_fatal_) paste(call, body[operation].token, result, operand);
  }
}

uint32_t Preprocessor::append_operand(Call& call, uint32_t i, bool is_raw, Tokens& result) {
  const MacroItem& item = call.macro->body[i];
  size_t before = result.size();
  uint32_t last = i;
  switch (item.role) {
    case MacroItem::kParameter: {
      const Tokens& argument =
          is_raw ? call.arguments[item.parameter] : expanded_argument(call, item.parameter);
      if (is_fatal_ || !count_tokens(argument.size(), call.macro->name)) return last;
      result.insert(result.end(), argument.begin(), argument.end());
      break;
    }
    case MacroItem::kStringize:
      result.push_back(stringize(call, item));
      break;
    case MacroItem::kVaOptBegin:
      last = item.end;
      if (has_variadic_tokens(call)) substitute(call, i + 1, item.end, result);
      break;
    default:
      result.push_back(item.token);
      result.back().location = sources_.expansion_token(call.expansion, item.token.location);
      result.back().flags &= static_cast<uint8_t>(~Token::kAtLineStart);
      return last;
  }
  if (is_fatal_) return last;
  if (result.size() > before) {
    copy_space(result[before], item.token);
  } else if (is_raw) {
    result.push_back(placemarker(item.token));
  }
  return last;
}

// Expanded as if it were alone in the file, and only once for all uses of the parameter.
const std::vector<Token>& Preprocessor::expanded_argument(Call& call, uint32_t parameter) {
  std::optional<Tokens>& known = call.expanded[parameter];
  if (known) return *known;
  known.emplace();
  if (++argument_depth_ > options_.max_macro_depth) {
    diagnostics_.report(DiagnosticId::kExpansionTooDeep, call.name.location,
                        {call.macro->name, std::to_string(options_.max_macro_depth)});
    --argument_depth_;
    fatal();
    return *known;
  }
  std::vector<Frame> outer = std::exchange(frames_, {});
  bool was_isolated = std::exchange(is_isolated_, true);
  frames_.push_back({call.arguments[parameter], 0, nullptr});
  for (Token token = next_expanded(); !token.is(TokenKind::kEndOfFile); token = next_expanded()) {
    known->push_back(token);
  }
  is_isolated_ = was_isolated;
  --argument_depth_;
  frames_ = std::move(outer);
  if (is_fatal_) fatal();
  return *known;
}

bool Preprocessor::has_variadic_tokens(Call& call) {
  return !expanded_argument(call, static_cast<uint32_t>(call.macro->parameters.size() - 1)).empty();
}

Token Preprocessor::stringize(Call& call, const MacroItem& item) {
  std::string text = "\"";
  const Tokens& argument = call.arguments[item.parameter];
  for (size_t i = 0; i < argument.size(); ++i) {
    const Token& token = argument[i];
    if (i > 0 && (token.flags & Token::kSpaceBefore)) text += ' ';
    bool is_quoted = token.is(TokenKind::kStringLiteral) || token.is(TokenKind::kCharacter);
    for (char c : token.text) {
      if (is_quoted && (c == '"' || c == '\\')) text += '\\';
      text += c;
    }
  }
  text += '"';
  count_tokens(text.size() / 16, call.macro->name);
  Token token = item.token;
  token.kind = TokenKind::kStringLiteral;
  token.text = sources_.keep(std::move(text));
  token.location = sources_.expansion_token(call.expansion, item.token.location);
  return token;
}

// Joins the last token of `left` and the first of `right`.
void Preprocessor::paste(Call& call, const Token& operation, Tokens& left, const Tokens& right) {
  Token first = left.back();
  const Token& second = right.front();
  if (first.is(TokenKind::kPlacemarker) || second.is(TokenKind::kPlacemarker)) {
    if (first.is(TokenKind::kPlacemarker)) {
      left.back() = second;
      copy_space(left.back(), first);
    }
    left.insert(left.end(), right.begin() + 1, right.end());
    return;
  }
  std::string text = std::string(first.text) + std::string(second.text);
  count_tokens(text.size() / 16, call.macro->name);
  Token pasted = lex_pasted(text);
  SourceLocation location = sources_.expansion_token(call.expansion, operation.location);
  if (pasted.is(TokenKind::kEndOfFile)) {
    diagnostics_.report(DiagnosticId::kPasteInvalid, location, {text, first.text, second.text});
    left.insert(left.end(), right.begin(), right.end());
    return;
  }
  pasted.flags = first.flags & Token::kSpaceBefore;
  pasted.location = location;
  left.back() = pasted;
  left.insert(left.end(), right.begin() + 1, right.end());
}

// Returns kEndOfFile if `text` is not exactly one token.
Token Preprocessor::lex_pasted(const std::string& text) {
  Lexer reader(sources_, sources_.keep(text), identifiers_);
  Token token = reader.next();
  bool is_one = !token.is(TokenKind::kUnknown) && token.text.size() == text.size() &&
                reader.next().is(TokenKind::kEndOfFile);
  return is_one ? token : Token{};
}

}  // namespace kaamos::hlsl
