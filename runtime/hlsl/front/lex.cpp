// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/lex.h"

#include <string>
#include <utility>

namespace kaamos::hlsl {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_word(char c) {
  return is_letter(c) || is_digit(c);
}
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// Longest first among those with the same beginning.
struct Punctuator {
  std::string_view text;
  TokenKind kind;
};
constexpr Punctuator kPunctuators[] = {
    {"<<=", TokenKind::kLessLessEqual},
    {">>=", TokenKind::kGreaterGreaterEqual},
    {"...", TokenKind::kEllipsis},
    {"<<", TokenKind::kLessLess},
    {"<=", TokenKind::kLessEqual},
    {">>", TokenKind::kGreaterGreater},
    {">=", TokenKind::kGreaterEqual},
    {"->", TokenKind::kArrow},
    {"--", TokenKind::kMinusMinus},
    {"-=", TokenKind::kMinusEqual},
    {"++", TokenKind::kPlusPlus},
    {"+=", TokenKind::kPlusEqual},
    {"*=", TokenKind::kStarEqual},
    {"/=", TokenKind::kSlashEqual},
    {"%=", TokenKind::kPercentEqual},
    {"==", TokenKind::kEqualEqual},
    {"!=", TokenKind::kExclaimEqual},
    {"&&", TokenKind::kAmpAmp},
    {"&=", TokenKind::kAmpEqual},
    {"||", TokenKind::kPipePipe},
    {"|=", TokenKind::kPipeEqual},
    {"^=", TokenKind::kCaretEqual},
    {"::", TokenKind::kColonColon},
    {"##", TokenKind::kHashHash},
    {"(", TokenKind::kLeftParen},
    {")", TokenKind::kRightParen},
    {"{", TokenKind::kLeftBrace},
    {"}", TokenKind::kRightBrace},
    {"[", TokenKind::kLeftBracket},
    {"]", TokenKind::kRightBracket},
    {";", TokenKind::kSemicolon},
    {",", TokenKind::kComma},
    {".", TokenKind::kDot},
    {":", TokenKind::kColon},
    {"?", TokenKind::kQuestion},
    {"+", TokenKind::kPlus},
    {"-", TokenKind::kMinus},
    {"*", TokenKind::kStar},
    {"/", TokenKind::kSlash},
    {"%", TokenKind::kPercent},
    {"<", TokenKind::kLess},
    {">", TokenKind::kGreater},
    {"=", TokenKind::kEqual},
    {"!", TokenKind::kExclaim},
    {"~", TokenKind::kTilde},
    {"&", TokenKind::kAmp},
    {"|", TokenKind::kPipe},
    {"^", TokenKind::kCaret},
    {"#", TokenKind::kHash},
};

// The first entry in kPunctuators for each first byte, so that most are found at the first try.
struct PunctuatorStarts {
  uint8_t first[128];
};
constexpr PunctuatorStarts punctuator_starts() {
  PunctuatorStarts result{};
  for (uint8_t& first : result.first) first = std::size(kPunctuators);
  for (size_t i = std::size(kPunctuators); i-- > 0;) {
    result.first[static_cast<size_t>(kPunctuators[i].text[0])] = static_cast<uint8_t>(i);
  }
  return result;
}
constexpr PunctuatorStarts kStarts = punctuator_starts();

}  // namespace

uint32_t IdentifierTable::intern(std::string_view text) {
  auto [entry, is_new] = by_text_.emplace(text, static_cast<uint32_t>(identifiers_.size()));
  if (is_new) identifiers_.push_back({text, keyword_kind(text), nullptr});
  return entry->second;
}

Lexer::Lexer(SourceManager& sources, SourceManager::FileIndex file, IdentifierTable& identifiers,
             DiagnosticEngine* diagnostics)
    : sources_(sources),
      file_(file),
      base_(sources.location(file, 0).raw),
      identifiers_(identifiers),
      diagnostics_(diagnostics) {
  const std::string& text = sources.text_of(file).text;
  begin_ = text.data();
  end_ = begin_ + text.size();
  position_ = begin_ + (text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
}

Lexer::Lexer(SourceManager& sources, std::string_view text, IdentifierTable& identifiers)
    : sources_(sources),
      identifiers_(identifiers),
      diagnostics_(nullptr),
      begin_(text.data()),
      end_(begin_ + text.size()),
      position_(begin_) {}

const char* Lexer::skip_splices(const char* p) const {
  while (*p == '\\') {
    const char* q = p + 1;
    while (is_blank(*q)) ++q;
    if (*q == '\r' && q[1] == '\n') ++q;
    if (*q != '\n' && *q != '\r') return p;
    p = q + 1;
  }
  return p;
}

void Lexer::skip_newline() {
  position_ += position_[0] == '\r' && position_[1] == '\n' ? 2 : 1;
}

void Lexer::skip_line_comment() {
  while (position_ < end_ && !is_newline(position_)) position_ = after(position_);
}

void Lexer::skip_block_comment() {
  SourceLocation begin = location();
  position_ = after(after(position_));
  while (position_ < end_) {
    const char* next = after(position_);
    if (*position_ == '*' && *next == '/') {
      position_ = next + 1;
      return;
    }
    position_ = next;
  }
  position_ = end_;
  if (diagnostics_) diagnostics_->report(DiagnosticId::kUnterminatedComment, begin);
}

bool Lexer::skip_space(Token& token) {
  for (;;) {
    position_ = skip_splices(position_);
    if (is_blank(*position_)) {
      ++position_;
    } else if (is_newline(position_)) {
      if (in_directive_) return false;
      skip_newline();
      at_line_start_ = true;
    } else if (*position_ == '/' && *after(position_) == '/') {
      skip_line_comment();
    } else if (*position_ == '/' && *after(position_) == '*') {
      skip_block_comment();
    } else {
      return true;
    }
    token.flags |= Token::kSpaceBefore;
  }
}

std::string_view Lexer::text_between(const char* begin, const char* end) {
  std::string_view raw(begin, static_cast<size_t>(end - begin));
  if (raw.find('\\') == std::string_view::npos) return raw;
  std::string clean;
  for (const char* p = skip_splices(begin); p < end; p = after(p)) clean += *p;
  if (clean.size() == raw.size()) return raw;
  return sources_.keep(std::move(clean));
}

void Lexer::finish(Token& token, TokenKind kind, const char* end) {
  token.kind = kind;
  token.text = text_between(position_, end);
  position_ = end;
}

Token Lexer::next() {
  Token token;
  bool has_more = skip_space(token);
  token.location = location();
  if (!has_more || position_ >= end_) {
    token.kind = in_directive_ ? TokenKind::kEndOfDirective : TokenKind::kEndOfFile;
    return token;
  }
  if (at_line_start_) token.flags |= Token::kAtLineStart;
  at_line_start_ = false;
  char c = *position_;
  if (is_letter(c)) {
    lex_identifier(token);
  } else if (is_digit(c) || (c == '.' && is_digit(*after(position_)))) {
    lex_number(token);
  } else if (c == '"' || c == '\'') {
    lex_quoted(token);
  } else {
    lex_punctuator(token);
  }
  return token;
}

void Lexer::lex_identifier(Token& token) {
  const char* p = position_ + 1;
  for (;;) {
    while (is_word(*p)) ++p;
    const char* q = skip_splices(p);
    if (q == p || !is_word(*q)) break;
    p = q;
  }
  finish(token, TokenKind::kIdentifier, p);
  if (!skipping_) token.value = identifiers_.intern(token.text);
}

// `.xxx` after a number is a swizzle of it, not its fraction [HLSL: 1.0.xxx].
bool Lexer::is_swizzle(const char* p) const {
  constexpr std::string_view kComponents = "xyzwrgba";
  size_t count = 0;
  while (count < 5 && *p != '\0' && kComponents.find(*p) != std::string_view::npos) {
    ++p;
    ++count;
  }
  return count >= 1 && count <= 4 && !is_word(*p);
}

void Lexer::lex_number(Token& token) {
  bool is_hex = *position_ == '0' && (*after(position_) == 'x' || *after(position_) == 'X');
  bool has_point = false;
  const char* p = position_;
  for (char previous = '\0';; previous = *p, p = after(p)) {
    const char* here = skip_splices(p);
    char c = *here;
    bool is_exponent =
        previous == 'p' || previous == 'P' || (!is_hex && (previous == 'e' || previous == 'E'));
    if (is_word(c) || ((c == '+' || c == '-') && is_exponent)) {
      p = here;
    } else if (c == '.' && !has_point && !is_swizzle(after(here))) {
      has_point = true;
      p = here;
    } else if (c == '#' && previous == '.' &&
               std::string_view(here, static_cast<size_t>(end_ - here)).starts_with("#INF")) {
      p = here;
    } else {
      break;
    }
  }
  finish(token, TokenKind::kNumber, p);
}

void Lexer::lex_quoted(Token& token) {
  char quote = *position_;
  const char* p = after(position_);
  while (p < end_ && !is_newline(p) && *p != quote) {
    if (*p == '\\' && !is_newline(after(p)) && after(p) < end_) p = after(p);
    p = after(p);
  }
  bool is_closed = p < end_ && *p == quote;
  if (!is_closed) {
    // The text shown does not include spaces and comments at the end of the line.
    finish(token, TokenKind::kUnknown, p < end_ ? p : end_);
    token.flags |= Token::kQuotedBroken;
    return;
  }
  finish(token, quote == '"' ? TokenKind::kStringLiteral : TokenKind::kCharacter, p + 1);
}

void Lexer::lex_punctuator(Token& token) {
  auto first = static_cast<unsigned char>(*position_);
  if (first >= 128) return lex_unknown(token);
  for (size_t i = kStarts.first[first]; i < std::size(kPunctuators); ++i) {
    const Punctuator& candidate = kPunctuators[i];
    if (candidate.text[0] != *position_) continue;
    const char* last = position_;
    size_t matched = 1;
    while (matched < candidate.text.size() && *after(last) == candidate.text[matched]) {
      last = after(last);
      ++matched;
    }
    if (matched < candidate.text.size()) continue;
    token.kind = candidate.kind;
    token.text = candidate.text;
    position_ = last + 1;
    return;
  }
  lex_unknown(token);
}

// One character, with all its bytes if it is UTF-8.
void Lexer::lex_unknown(Token& token) {
  const char* p = position_ + 1;
  if (static_cast<unsigned char>(*position_) >= 0xC0) {
    while (p < end_ && (static_cast<unsigned char>(*p) & 0xC0) == 0x80) ++p;
  }
  token.kind = TokenKind::kUnknown;
  token.text = {position_, static_cast<size_t>(p - position_)};
  position_ = p;
}

bool Lexer::is_left_paren_next() {
  const char* position = position_;
  bool at_line_start = at_line_start_;
  DiagnosticEngine* diagnostics = std::exchange(diagnostics_, nullptr);
  Token ignored;
  bool result = skip_space(ignored) && position_ < end_ && *position_ == '(';
  position_ = position;
  at_line_start_ = at_line_start;
  diagnostics_ = diagnostics;
  return result;
}

bool Lexer::read_angled_name(Token& token) {
  const char* position = position_;
  token = Token{};
  if (!skip_space(token) || *position_ != '<') {
    position_ = position;
    return false;
  }
  token.location = location();
  const char* p = position_ + 1;
  while (p < end_ && !is_newline(p) && *p != '>') ++p;
  if (p >= end_ || *p != '>') {
    position_ = position;
    return false;
  }
  token.kind = TokenKind::kUnknown;
  token.text = {position_ + 1, static_cast<size_t>(p - position_ - 1)};
  position_ = p + 1;
  return true;
}

std::string_view Lexer::rest_of_line() {
  position_ = skip_splices(position_);
  while (is_blank(*position_)) ++position_;
  const char* begin = position_;
  while (position_ < end_ && !is_newline(position_)) position_ = after(position_);
  std::string_view text = text_between(begin, position_ < end_ ? position_ : end_);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace kaamos::hlsl
