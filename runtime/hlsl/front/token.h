// SPDX-License-Identifier: MIT
// The tokens that the lexer and the preprocessor pass to the parser.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "runtime/hlsl/front/literal.h"
#include "runtime/hlsl/front/source.h"

namespace kaamos::hlsl {

enum class TokenKind : uint8_t {
#define KAAMOS_TOKEN(name, text) name,
#include "runtime/hlsl/front/token_kinds.inc"
};

struct Token {
  enum Flag : uint8_t {
    kAtLineStart = 1,   // First on its line in the file.
    kSpaceBefore = 2,   // White space or a comment comes before it.
    kNoExpand = 4,      // Its macro was being expanded, so it is never a macro again [C++: rescan].
    kQuotedBroken = 8,  // An unterminated string or character, already reported.
  };

  TokenKind kind = TokenKind::kEndOfFile;
  uint8_t flags = 0;
  SourceLocation location;
  // For names and keywords, a number that is the same for the same text. For numbers, the index
  // into TokenList::numbers.
  uint32_t value = 0;
  // As written, with line continuations removed. kStringLiteral: the value, with escapes resolved
  // and adjacent literals joined. kPragmaPackMatrix: row_major or column_major. Lives as long as
  // the SourceManager.
  std::string_view text;

  bool is(TokenKind k) const { return kind == k; }
};

struct TokenList {
  std::vector<Token> tokens;  // The last one is kEndOfFile.
  std::vector<NumberLiteral> numbers;

  const NumberLiteral& number(const Token& token) const { return numbers[token.value]; }
};

// "(" for kLeftParen, "name" for kIdentifier.
std::string_view token_kind_text(TokenKind kind);
// The token as diagnostics quote it: 'foo', end of file.
std::string describe(const Token& token);
// A keyword, a reserved word, or kIdentifier.
TokenKind keyword_kind(std::string_view text);
bool is_keyword(TokenKind kind);
// sample, payload, ...: keywords that DXC also accepts as the names of variables, fields,
// parameters and functions.
bool is_contextual_keyword(TokenKind kind);
inline bool can_be_name(TokenKind kind) {
  return kind == TokenKind::kIdentifier || is_contextual_keyword(kind);
}
// Names, keywords and `::`: what may follow a modifier.
inline bool can_begin_type(TokenKind kind) {
  return kind == TokenKind::kIdentifier || kind == TokenKind::kReservedWord || is_keyword(kind) ||
         kind == TokenKind::kColonColon;
}

}  // namespace kaamos::hlsl
