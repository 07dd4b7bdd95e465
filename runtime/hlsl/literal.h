// SPDX-License-Identifier: MIT
// The value of a number as written in the source.
#pragma once

#include <cstdint>

namespace kaamos::hlsl {

enum class LiteralSuffix : uint8_t { kNone, kU, kL, kUL, kF, kH };

struct NumberLiteral {
  bool is_float = false;
  bool is_decimal = true;                       // False for 0x.., 0b.. and 0.. (octal).
  LiteralSuffix suffix = LiteralSuffix::kNone;  // `ll` reads as kL, `ull` as kUL.
  uint64_t integer = 0;                         // Where !is_float.
  double real = 0;                              // Where is_float.
};

}  // namespace kaamos::hlsl
