// SPDX-License-Identifier: MIT
// The values of numbers and strings as written in the source.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/hlsl/front/source.h"

namespace kaamos::hlsl {

class DiagnosticEngine;

enum class LiteralSuffix : uint8_t { kNone, kU, kL, kUL, kF, kH };

struct NumberLiteral {
  bool is_float = false;
  bool is_decimal = true;                       // False for 0x.., 0b.. and 0.. (octal).
  LiteralSuffix suffix = LiteralSuffix::kNone;  // `ll` is read as kL, `ull` as kUL.
  uint64_t integer = 0;                         // If !is_float.
  // If is_float; with suffix f, and in decimal with suffix h, already rounded to float.
  double real = 0;
};

// Reads a number as DXC does, 1.#INF included. Reports errors and then returns a best guess, so
// that parsing can go on.
NumberLiteral parse_number(std::string_view text, SourceLocation location,
                           DiagnosticEngine& diagnostics);
// A character literal is a uint: its one byte, sign-extended. `text` includes its quotes.
NumberLiteral parse_character(std::string_view text, SourceLocation location,
                              DiagnosticEngine& diagnostics);
// `text` includes its quotes; escapes are resolved.
std::string parse_quoted(std::string_view text, SourceLocation location,
                         DiagnosticEngine& diagnostics);

}  // namespace kaamos::hlsl
