// SPDX-License-Identifier: MIT
//
// Elementary functions, in the same steps for one number and for those of several threads, so that
// both give the same bits. F is float, or a vector of floats; `Bits` gives its bits as unsigned
// integers, `Floats` makes floats from such bits; `Choose` returns its second operand where a
// condition holds and the third elsewhere; `Every` says whether a condition holds everywhere.
#pragma once

#include "kaamos/shader/half.h"

namespace kaamos::shader::op {

// e^x within 1 ulp: 2^k e^r with an integer k and r within ln(2) / 2; e^r is a polynomial.
template <class F, class Bits, class Floats, class Choose, class Every>
KAAMOS_INLINE F exponential(F x, const Bits& bits, const Floats& floats, const Choose& choose,
                            const Every& every) {
  const F shifted = x * 1.44269504f + 12582912.0f;  // 1.5 * 2^23: puts k into the lowest bits
  const F k = shifted - 12582912.0f;
  const F r = (x - k * 0.693359375f) - k * -2.12194440e-4f;
  F p = r * 1.9875691500e-4f + 1.3981999507e-3f;
  p = p * r + 8.3334519073e-3f;
  p = p * r + 4.1665795894e-2f;
  p = p * r + 1.6666665459e-1f;
  p = p * r + 5.0000001201e-1f;
  const F y = p * r * r + r + 1.0f;
  F result = floats(bits(y) + (bits(shifted) << 23));
  if (__builtin_expect(every(floats(bits(x) & 0x7FFFFFFFu) <= 87.3365402f), 1)) return result;
  // Replaces results whose exponent is out of range: above the largest float, below the smallest
  // normal one (D3D flushes denormals), and NaN.
  result = choose(x > 88.7228317f, F{} + __builtin_inff(), result);
  result = choose(x < -87.3365402f, F{}, result);
  return choose(x == x, result, x);
}

// Sine and cosine within 2 ulp up to kLargestAngle, as x = k pi/2 + r with r within pi/4: a
// polynomial of r (sine or cosine, depending on whether k is even or odd) with a sign. `Large`
// computes larger angles.
inline constexpr float kLargestAngle = 512.0f;
enum class Wave : uint32_t { kSine = 0, kCosine = 1 };

template <Wave W, class F, class Bits, class Floats, class Every, class Large>
KAAMOS_INLINE F wave(F x, const Bits& bits, const Floats& floats, const Every& every,
                     const Large& large) {
  const F a = floats(bits(x) & 0x7FFFFFFFu);
  const F shifted = a * 0.636619772f + 12582912.0f;  // 1.5 * 2^23: puts k into the lowest bits
  const F k = shifted - 12582912.0f;
  // pi/2 in parts short enough that their products with k are exact.
  const F r = (((a - k * 1.5703125f) - k * 0x1.FB4p-12f) - k * 0x1.444p-24f) - k * 0x1.68C234p-39f;
  const F z = r * r;
  const F sine = ((z * -1.9515295891e-4f + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * r + r;
  const F cosine =
      ((z * 2.443315711809948e-5f - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z -
      0.5f * z + 1.0f;
  const auto turn = bits(shifted) + static_cast<uint32_t>(W);
  const auto odd = 0u - (turn & 1u);
  auto sign = (turn & 2u) << 30;
  if constexpr (W == Wave::kSine) sign ^= bits(x) & 0x80000000u;
  const F result = floats(((bits(cosine) & odd) | (bits(sine) & ~odd)) ^ sign);
  if (__builtin_expect(every(a <= kLargestAngle), 1)) return result;
  return large(x, result);
}

KAAMOS_INLINE float exponential(float x) {
  return exponential(
      x, [](float f) KAAMOS_INLINE_LAMBDA { return __builtin_bit_cast(uint32_t, f); },
      [](uint32_t i) KAAMOS_INLINE_LAMBDA { return __builtin_bit_cast(float, i); },
      [](bool c, float a, float b) KAAMOS_INLINE_LAMBDA { return c ? a : b; },
      [](bool c) KAAMOS_INLINE_LAMBDA { return c; });
}
template <Wave W>
[[gnu::noinline, gnu::cold]] inline float wave_of_large(float x) {
  return W == Wave::kSine ? __builtin_sinf(x) : __builtin_cosf(x);
}
template <Wave W>
KAAMOS_INLINE float wave(float x) {
  return wave<W>(
      x, [](float f) KAAMOS_INLINE_LAMBDA { return __builtin_bit_cast(uint32_t, f); },
      [](uint32_t i) KAAMOS_INLINE_LAMBDA { return __builtin_bit_cast(float, i); },
      [](bool c) KAAMOS_INLINE_LAMBDA { return c; },
      [](float large, float) KAAMOS_INLINE_LAMBDA { return wave_of_large<W>(large); });
}
KAAMOS_INLINE float sine(float x) {
  return wave<Wave::kSine>(x);
}
KAAMOS_INLINE float cosine(float x) {
  return wave<Wave::kCosine>(x);
}

}  // namespace kaamos::shader::op
