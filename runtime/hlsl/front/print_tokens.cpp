// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/print_tokens.h"

#include <cstdio>

namespace kaamos::hlsl {
namespace {

// Empty lines up to here cost less than a directive.
constexpr uint32_t kMostEmptyLines = 8;

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20) {
      // Three octal digits end where they end, whatever comes next.
      char octal[8];
      std::snprintf(octal, sizeof(octal), "\\%03o", static_cast<unsigned>(byte));
      out += octal;
    } else {
      out += c;
    }
  }
  return out + "\"";
}

class TokenPrinter {
 public:
  explicit TokenPrinter(const SourceManager& sources) : sources_(sources) {}

  void print(const Token& token) {
    const bool is_pragma = token.is(TokenKind::kPragmaPackMatrix);
    const ResolvedLocation place = sources_.resolve(token.location);
    const bool moved = go_to(place, is_pragma);
    // Tokens of a macro may touch in the text where they must not become one.
    const bool is_apart =
        (token.flags & Token::kSpaceBefore) != 0 || token.location.is_macro() || after_macro_;
    if (!moved && is_apart) out_ += ' ';
    if (is_pragma) {
      out_ += "#pragma pack_matrix(" + std::string(token.text) + ")\n";
      ++line_;
      at_line_start_ = true;
    } else {
      out_ += token.is(TokenKind::kStringLiteral) ? quoted(token.text) : std::string(token.text);
      at_line_start_ = false;
    }
    after_macro_ = token.location.is_macro();
  }
  std::string take() {
    if (!at_line_start_) out_ += '\n';
    return std::move(out_);
  }

 private:
  // True if the token begins a line.
  bool go_to(const ResolvedLocation& place, bool must_start_line) {
    const bool is_same_file = place.path == path_;
    if (is_same_file && place.line == line_ && !must_start_line) return at_line_start_;
    if (is_same_file && place.line >= line_ && place.line <= line_ + kMostEmptyLines) {
      if (place.line == line_ && !at_line_start_) out_ += '\n', line_ += 1;
      for (; line_ < place.line; ++line_) out_ += '\n';
    } else {
      if (!at_line_start_) out_ += '\n';
      out_ += "#line " + std::to_string(place.line) + " " + quoted(place.path) + "\n";
      path_ = place.path;
    }
    line_ = place.line;
    at_line_start_ = true;
    return true;
  }

  const SourceManager& sources_;
  std::string out_;
  std::string path_;
  uint32_t line_ = 0;
  bool at_line_start_ = true;
  bool after_macro_ = false;
};

}  // namespace

std::string print_tokens(const TokenList& tokens, const SourceManager& sources) {
  TokenPrinter printer(sources);
  for (const Token& token : tokens.tokens) {
    if (!token.is(TokenKind::kEndOfFile)) printer.print(token);
  }
  return printer.take();
}

}  // namespace kaamos::hlsl
