// SPDX-License-Identifier: MIT
// Cuts the text of one file into preprocessing tokens [C++: lex.pptoken]. It reports nothing except
// an unterminated comment, because an error in a token only matters where the token is used.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/front/source.h"
#include "runtime/hlsl/front/token.h"

namespace kaamos::hlsl {

struct Macro;

// Everything known about a name; each distinct text has one entry.
struct Identifier {
  std::string_view text;
  TokenKind keyword = TokenKind::kIdentifier;
  Macro* macro = nullptr;
};

class IdentifierTable {
 public:
  // `text` must live as long as the table.
  uint32_t intern(std::string_view text);
  Identifier& operator[](uint32_t index) { return identifiers_[index]; }

 private:
  std::unordered_map<std::string_view, uint32_t> by_text_;
  std::vector<Identifier> identifiers_;
};

class Lexer {
 public:
  Lexer(SourceManager& sources, SourceManager::FileIndex file, IdentifierTable& identifiers,
        DiagnosticEngine* diagnostics);
  // For a text without a location, such as the result of `##`; a zero byte must follow it. The
  // tokens have no location.
  Lexer(SourceManager& sources, std::string_view text, IdentifierTable& identifiers);

  // Names (including keywords) get kind kIdentifier; numbers get kNumber and their text. After the
  // last token, every call returns kEndOfFile.
  Token next();
  // Between begin and end, the end of the line reads as kEndOfDirective, over and over.
  void begin_directive() { in_directive_ = true; }
  void end_directive() { in_directive_ = false; }
  bool in_directive() const { return in_directive_; }
  // While a group is skipped because of #if, names are not entered into the table.
  void set_skipping(bool skipping) { skipping_ = skipping; }

  // Returns whether '(' comes next without any space.
  bool is_left_paren_adjacent() const { return *skip_splices(position_) == '('; }
  // Returns whether the next token is '('; consumes nothing.
  bool is_left_paren_next();
  // At `<`: reads up to `>` on this line as one kUnknown token whose text is what is in between.
  // Returns false and reads nothing if there is no `<...>`.
  bool read_angled_name(Token& token);
  // Reads the rest of the line and returns it as written, without surrounding spaces.
  std::string_view rest_of_line();

  SourceManager::FileIndex file() const { return file_; }
  SourceLocation location() const { return at(position_); }
  uint32_t offset() const { return static_cast<uint32_t>(position_ - begin_); }

 private:
  SourceLocation at(const char* p) const {
    return {base_ ? base_ + static_cast<uint32_t>(p - begin_) : 0};
  }
  const char* skip_splices(const char* p) const;
  const char* after(const char* p) const { return skip_splices(p + 1); }
  bool is_newline(const char* p) const { return *p == '\n' || *p == '\r'; }
  void skip_newline();
  void skip_line_comment();
  void skip_block_comment();
  // Returns false at the end of a directive.
  bool skip_space(Token& token);
  std::string_view text_between(const char* begin, const char* end);
  void finish(Token& token, TokenKind kind, const char* end);
  void lex_identifier(Token& token);
  void lex_number(Token& token);
  bool is_swizzle(const char* p) const;
  void lex_quoted(Token& token);
  void lex_punctuator(Token& token);
  void lex_unknown(Token& token);

  SourceManager& sources_;
  SourceManager::FileIndex file_ = 0;
  uint32_t base_ = 0;
  IdentifierTable& identifiers_;
  DiagnosticEngine* diagnostics_;
  const char* begin_;
  const char* end_;
  const char* position_;
  bool at_line_start_ = true;
  bool in_directive_ = false;
  bool skipping_ = false;
};

}  // namespace kaamos::hlsl
