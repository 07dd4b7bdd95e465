// SPDX-License-Identifier: MIT
// Values of numbers and strings as written in the source.
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
  LiteralSuffix suffix = LiteralSuffix::kNone;  // `ll` reads as kL, `ull` as kUL.
  uint64_t integer = 0;                         // Where !is_float.
  double real = 0;  // Where is_float; with suffix f or h already rounded to float.
};

// Reads a number as DXC does, 1.#INF included. Reports what is wrong and then returns the best
// guess, so that parsing goes on.
NumberLiteral parse_number(std::string_view text, SourceLocation location,
                           DiagnosticEngine& diagnostics);
// `text` with its quotes; resolves the escapes.
std::string parse_quoted(std::string_view text, SourceLocation location,
                         DiagnosticEngine& diagnostics);

}  // namespace kaamos::hlsl
