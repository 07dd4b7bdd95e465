// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/parse.h"

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {

const TranslationUnit* parse(const TokenList& tokens, AstArena& arena,
                             DiagnosticEngine& diagnostics) {
  return Parser(tokens, arena, diagnostics).translation_unit();
}

namespace {

std::vector<Token> without_pragmas(const TokenList& list) {
  std::vector<Token> result;
  result.reserve(list.tokens.size() + 1);
  for (const Token& token : list.tokens) {
    if (!token.is(TokenKind::kPragmaPackMatrix)) result.push_back(token);
  }
  if (result.empty() || !result.back().is(TokenKind::kEndOfFile)) result.emplace_back();
  return result;
}

}  // namespace

Parser::Parser(const TokenList& tokens, AstArena& arena, DiagnosticEngine& diagnostics)
    : tokens_(without_pragmas(tokens)),
      source_(tokens),
      arena_(arena),
      diagnostics_(diagnostics),
      scopes_(tokens_) {
  size_t index = 0;
  for (const Token& token : tokens.tokens) {
    if (token.is(Kind::kPragmaPackMatrix)) {
      const bool is_row = token.text == "row_major";
      pack_matrix_.push_back({index, is_row ? kModRowMajor : kModColumnMajor});
    } else {
      ++index;
    }
  }
}

const TranslationUnit* Parser::translation_unit() {
  DeclList declarations;
  declarations_until(Kind::kEndOfFile, Context::kGlobal, declarations);
  TranslationUnit* unit = arena_.make<TranslationUnit>();
  unit->declarations = list(declarations);
  return unit;
}

Parser::Nesting::Nesting(Parser& parser) : parser_(parser) {
  if (++parser_.depth_ <= kMaxNesting) return;
  ok = false;
  parser_.fail_here(DiagnosticId::kNestedTooDeep, {std::to_string(kMaxNesting)});
}

// ---- Tokens

void Parser::advance() {
  if (pos_ + 1 < tokens_.size()) ++pos_;
}

bool Parser::accept(Kind kind) {
  if (!at(kind)) return false;
  advance();
  return true;
}

bool Parser::accept_template_end() {
  Kind rest;
  switch (token().kind) {
    case Kind::kGreater:
      advance();
      return true;
    case Kind::kGreaterGreater:
      rest = Kind::kGreater;
      break;
    case Kind::kGreaterEqual:
      rest = Kind::kEqual;
      break;
    case Kind::kGreaterGreaterEqual:
      rest = Kind::kGreaterEqual;
      break;
    default:
      return false;
  }
  Token& split = tokens_[pos_];
  split.kind = rest;
  split.location = split.location.advanced(1);
  split.text = split.text.substr(1);
  split.flags = 0;
  return true;
}

bool Parser::expect(Kind kind, std::string_view expected) {
  if (accept(kind)) return true;
  fail_here(DiagnosticId::kExpectedToken, {expected, describe(token())});
  return false;
}

bool Parser::expect_semicolon(std::string_view after) {
  if (panic_) return false;
  if (accept(Kind::kSemicolon)) return true;
  // If the next token begins a line, the mistake is at the end of the previous one.
  SourceLocation location = here();
  const bool next_line = (token().flags & Token::kAtLineStart) != 0 || at_end();
  if (pos_ > 0 && next_line && !here().is_macro()) {
    const Token& before = tokens_[pos_ - 1];
    location = before.location;
    if (!before.is(Kind::kStringLiteral)) {
      location = location.advanced(static_cast<uint32_t>(before.text.size()));
    }
  }
  fail(DiagnosticId::kExpectedSemicolon, location, {after, describe(token())});
  return false;
}

bool Parser::expect_closing(Kind kind, size_t open, std::string_view after) {
  if (panic_) return false;
  if (accept(kind)) return true;
  const std::string expected = "'" + std::string(token_kind_text(kind)) + "'";
  fail_here(DiagnosticId::kExpectedClosing, {expected, after, describe(token())})
      .note(token_at(open).location, "to match this " + describe(token_at(open)));
  return false;
}

bool Parser::expect_list_end(Kind kind, size_t open, std::string_view after) {
  if (panic_) return false;
  if (accept(kind)) return true;
  const std::string expected = "',' or '" + std::string(token_kind_text(kind)) + "'";
  fail_here(DiagnosticId::kExpectedClosing, {expected, after, describe(token())})
      .note(token_at(open).location, "to match this " + describe(token_at(open)));
  return false;
}

bool Parser::expect_template_end(size_t open) {
  if (panic_) return false;
  if (accept_template_end()) return true;
  fail_here(DiagnosticId::kExpectedClosing,
            {"',' or '>'", "a template argument", describe(token())})
      .note(token_at(open).location, "to match this '<'");
  return false;
}

const Token* Parser::expect_name(std::string_view what, NameKind kind) {
  if (panic_) return nullptr;
  if (kind == NameKind::kAnyName ? !at_name() : !at(Kind::kIdentifier)) {
    if (is_keyword(token().kind) || at(Kind::kReservedWord)) {
      refused_names_.push_back(token().value);
      fail_here(DiagnosticId::kKeywordAsName, {token().text, what});
    } else {
      fail_here(DiagnosticId::kExpectedName, {what, describe(token())});
    }
    return nullptr;
  }
  const Token* name = &token();
  if (is_type_keyword(name->text)) {
    fail_here(DiagnosticId::kBuiltinTypeAsName, {name->text, what});
    return nullptr;
  }
  advance();
  return name;
}

// ---- Errors and recovery

DiagnosticEngine::Report Parser::report(DiagnosticId id, SourceLocation location,
                                        std::initializer_list<std::string_view> arguments) {
  if (panic_) return DiagnosticEngine::Report(nullptr);
  return diagnostics_.report(id, location, arguments);
}

DiagnosticEngine::Report Parser::fail(DiagnosticId id, SourceLocation location,
                                      std::initializer_list<std::string_view> arguments) {
  if (panic_) return DiagnosticEngine::Report(nullptr);
  panic_ = true;
  return diagnostics_.report(id, location, arguments);
}

size_t Parser::behind_closing(size_t open) const {
  const bool in_braces = token_at(open).is(Kind::kLeftBrace);
  // Only `for (;;)` has semicolons in parentheses; anywhere else, one means that the `)` is
  // missing.
  const bool in_for = open > 0 && tokens_[open - 1].is(Kind::kFor);
  size_t depth = 0;
  for (size_t i = open; i < tokens_.size(); ++i) {
    switch (tokens_[i].kind) {
      case Kind::kLeftParen:
      case Kind::kLeftBracket:
        if (!in_braces) ++depth;
        break;
      case Kind::kRightParen:
      case Kind::kRightBracket:
        if (!in_braces && --depth == 0) return i + 1;
        break;
      case Kind::kLeftBrace:
        if (!in_braces) return i;
        ++depth;
        break;
      case Kind::kRightBrace:
        if (!in_braces) return i;
        if (--depth == 0) return i + 1;
        break;
      case Kind::kSemicolon:
        if (!in_braces && !in_for) return i;
        break;
      default:
        break;
    }
  }
  return tokens_.size() - 1;
}

bool Parser::starts_new_item(size_t index) {
  const Token& candidate = token_at(index);
  if ((candidate.flags & Token::kAtLineStart) == 0) return false;
  switch (candidate.kind) {
    case Kind::kIf:
    case Kind::kFor:
    case Kind::kWhile:
    case Kind::kDo:
    case Kind::kSwitch:
    case Kind::kReturn:
    case Kind::kBreak:
    case Kind::kContinue:
    case Kind::kDiscard:
    case Kind::kCase:
    case Kind::kDefault:
    case Kind::kStruct:
    case Kind::kClass:
    case Kind::kEnum:
    case Kind::kCbuffer:
    case Kind::kTbuffer:
    case Kind::kNamespace:
    case Kind::kTemplate:
    case Kind::kTypedef:
    case Kind::kUsing:
    case Kind::kStatic:
    case Kind::kGroupshared:
    case Kind::kVoid:
    case Kind::kConst:
    case Kind::kExport:
    case Kind::kInline:
      return true;
    case Kind::kLeftBracket:
      return is_name(index + 1) && !is_name(index - 1);
    default: {
      if (!is_name(index)) return false;
      const NameLookup name = look_up(index);
      return name.is_type() && is_name(name.end);
    }
  }
}

void Parser::recover(size_t begin) {
  panic_ = false;
  if (diagnostics_.should_stop()) pos_ = tokens_.size() - 1;
  while (!at_end()) {
    switch (token().kind) {
      case Kind::kSemicolon:
        advance();
        return;
      case Kind::kRightBrace:
        return;
      case Kind::kLeftBrace:
        pos_ = behind_closing(pos_);
        accept(Kind::kSemicolon);
        return;
      case Kind::kLeftParen:
      case Kind::kLeftBracket:
        if (pos_ != begin && starts_new_item(pos_)) return;
        pos_ = behind_closing(pos_);
        break;
      default:
        if (pos_ != begin && starts_new_item(pos_)) return;
        advance();
        break;
    }
  }
}

void Parser::recover_behind_paren(size_t open) {
  if (!panic_ || diagnostics_.should_stop()) return;
  const size_t end = behind_closing(open);
  if (end < pos_ || !token_at(end - 1).is(Kind::kRightParen)) return;
  pos_ = end;
  panic_ = false;
}

void Parser::recover_behind_brace(size_t open) {
  if (!panic_ || diagnostics_.should_stop()) return;
  const size_t end = behind_closing(open);
  if (end < pos_ || !token_at(end - 1).is(Kind::kRightBrace)) return;
  pos_ = end;
  panic_ = false;
}

}  // namespace kaamos::hlsl
