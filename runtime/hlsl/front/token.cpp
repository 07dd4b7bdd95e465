// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/token.h"

#include <unordered_map>

namespace kaamos::hlsl {
namespace {

constexpr std::string_view kTexts[] = {
#define KAAMOS_TOKEN(name, text) text,
#include "runtime/hlsl/front/token_kinds.inc"
};

// Words that DXC's lexer reserves without a meaning in HLSL.
constexpr std::string_view kReserved[] = {
#define KAAMOS_RESERVED(text) text,
#include "runtime/hlsl/front/reserved_words.inc"
};

const std::unordered_map<std::string_view, TokenKind>& keywords() {
  static const std::unordered_map<std::string_view, TokenKind> table = [] {
    std::unordered_map<std::string_view, TokenKind> result;
#define KAAMOS_PUNCTUATOR(name, text)
#define KAAMOS_KEYWORD(name, text) result.emplace(text, TokenKind::name);
#define KAAMOS_ALIAS(name, text) result.emplace(text, TokenKind::name);
#include "runtime/hlsl/front/token_kinds.inc"
    for (std::string_view word : kReserved) result.emplace(word, TokenKind::kReservedWord);
    return result;
  }();
  return table;
}

}  // namespace

std::string_view token_kind_text(TokenKind kind) {
  return kTexts[static_cast<size_t>(kind)];
}

std::string describe(const Token& token) {
  switch (token.kind) {
    case TokenKind::kEndOfFile:
    case TokenKind::kEndOfDirective:
      return std::string(token_kind_text(token.kind));
    case TokenKind::kPragmaPackMatrix:
      return "'#pragma pack_matrix'";
    case TokenKind::kStringLiteral:
      return token.text.starts_with('"') ? std::string(token.text)
                                         : "\"" + std::string(token.text) + "\"";
    default:
      return "'" + std::string(token.text) + "'";
  }
}

TokenKind keyword_kind(std::string_view text) {
  auto found = keywords().find(text);
  return found == keywords().end() ? TokenKind::kIdentifier : found->second;
}

bool is_keyword(TokenKind kind) {
  return kind >= TokenKind::kBreak;
}

bool is_contextual_keyword(TokenKind kind) {
  switch (kind) {
#define KAAMOS_KEYWORD(name, text)
#define KAAMOS_CONTEXTUAL(name, text) case TokenKind::name:
#include "runtime/hlsl/front/token_kinds.inc"
    return true;
    default:
      return false;
  }
}

}  // namespace kaamos::hlsl
