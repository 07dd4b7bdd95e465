// SPDX-License-Identifier: MIT
//
// float16 as 16 stored bits. Arithmetic goes through float, whose 24-bit significand is wide enough
// (>= 2 * 11 + 2) that rounding twice gives the correctly rounded half result of + - * / and sqrt.
// Not _Float16, because clang 14 lacks it on x86-64 and gcc 12's needs libgcc symbols.
#pragma once

#include <cstdint>

// always_inline keeps debug builds fast enough; artificial lets a debugger step over the library.
#define KAAMOS_INLINE [[gnu::always_inline, gnu::artificial]] inline
#define KAAMOS_CONSTEXPR [[gnu::always_inline, gnu::artificial]] inline constexpr

// To be put after a lambda's parameter list.
#define KAAMOS_INLINE_LAMBDA __attribute__((always_inline))

// To be put before a `for` that has a condition.
#define KAAMOS_PRAGMA(text) _Pragma(#text)
#ifdef __clang__
#define KAAMOS_UNROLL(times) KAAMOS_PRAGMA(clang loop unroll_count(times))
#else
#define KAAMOS_UNROLL(times) KAAMOS_PRAGMA(GCC unroll times)
#endif

namespace kaamos::shader {

struct half {
  uint16_t bits;
};

// Exact; a NaN keeps its sign and the top of its payload, and becomes quiet.
KAAMOS_CONSTEXPR float to_float(half h) {
  const uint32_t sign = static_cast<uint32_t>(h.bits & 0x8000u) << 16;
  const uint32_t magnitude = h.bits & 0x7FFFu;
  if (magnitude >= 0x7C00u) {
    const uint32_t quiet = magnitude > 0x7C00u ? 0x400000u : 0u;
    return __builtin_bit_cast(float, sign | 0x7F800000u | quiet | (magnitude & 0x3FFu) << 13);
  }
  if (magnitude < 0x400u) {  // zero or denormal: a multiple of 2^-24
    const float value = static_cast<float>(static_cast<int32_t>(magnitude)) * 0x1p-24f;
    return __builtin_bit_cast(float, sign | __builtin_bit_cast(uint32_t, value));
  }
  return __builtin_bit_cast(float, sign | ((magnitude << 13) + 0x38000000u));
}

// Rounds to nearest even; overflow gives infinity.
KAAMOS_CONSTEXPR half to_half(float value) {
  const uint32_t bits = __builtin_bit_cast(uint32_t, value);
  const uint32_t sign = bits >> 16 & 0x8000u;
  const uint32_t magnitude = bits & 0x7FFFFFFFu;
  if (magnitude > 0x7F800000u) {
    return {static_cast<uint16_t>(sign | 0x7E00u | (magnitude >> 13 & 0x3FFu))};
  }
  if (magnitude >= 0x477FF000u) return {static_cast<uint16_t>(sign | 0x7C00u)};
  if (magnitude < 0x38800000u) {
    // In a sum with 0.5, one unit in the last place is 2^-24, the step between half's denormals, so
    // the addition rounds to nearest even.
    const float sum = __builtin_bit_cast(float, magnitude) + 0.5f;
    return {static_cast<uint16_t>(sign | (__builtin_bit_cast(uint32_t, sum) - 0x3F000000u))};
  }
  const uint32_t rounded = magnitude - 0x38000000u + 0xFFFu + (magnitude >> 13 & 1u);
  return {static_cast<uint16_t>(sign | rounded >> 13)};
}

// Rounds toward zero, so that what is finite stays finite: 65536 becomes 65504. That is how formats
// convert; conversions in shaders round to nearest. [D3D11.3 3.2.2]
KAAMOS_CONSTEXPR half to_half_toward_zero(float value) {
  const uint32_t bits = __builtin_bit_cast(uint32_t, value);
  const uint32_t sign = bits >> 16 & 0x8000u;
  const uint32_t magnitude = bits & 0x7FFFFFFFu;
  if (magnitude >= 0x7F800000u) return to_half(value);
  if (magnitude >= 0x477FE000u) return {static_cast<uint16_t>(sign | 0x7BFFu)};
  if (magnitude >= 0x38800000u) {
    return {static_cast<uint16_t>(sign | (magnitude - 0x38000000u) >> 13)};
  }
  // A multiple of 2^-24.
  const float steps = __builtin_bit_cast(float, magnitude) * 0x1p24f;
  return {static_cast<uint16_t>(sign | static_cast<uint32_t>(static_cast<int32_t>(steps)))};
}

// Rounding to nearest float first would round twice, so the float is rounded to odd.
KAAMOS_CONSTEXPR half to_half(double value) {
  const float nearest = static_cast<float>(value);
  if (nearest != nearest || static_cast<double>(nearest) == value) return to_half(nearest);
  uint32_t bits = __builtin_bit_cast(uint32_t, nearest);
  const double magnitude = value < 0 ? -value : value;
  const double rounded = static_cast<double>(__builtin_bit_cast(float, bits & 0x7FFFFFFFu));
  if (rounded > magnitude) bits -= 1;
  return to_half(__builtin_bit_cast(float, bits | 1u));
}

}  // namespace kaamos::shader
