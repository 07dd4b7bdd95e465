// SPDX-License-Identifier: MIT
//
// Inputs and outputs of vertex and pixel shaders that run all lanes at once, and derivatives.
#pragma once

#include "kaamos/shader/columns.h"
#include "kaamos/shader/wave_op.h"
#include "kaamos/shader/wide_operators.h"

namespace kaamos::shader {

static_assert(kGraphicsLanes == kLanes);

KAAMOS_INLINE lanes lanes_of_bits(uint32_t bits) {
  const wide<uint32_t> numbers = lane_numbers();
  return by_register<bool>(
      [bits](auto n) KAAMOS_INLINE_LAMBDA { return (simd::Ints)((bits >> n & 1u) != 0u); },
      numbers);
}

// W is a wide scalar or vector of float, int32_t or uint32_t.
template <class W>
KAAMOS_INLINE W wide_column_value(const Column* columns) {
  W value;
  static_assert(sizeof(W) == sizeof(Column) * shape<W>::count);
  __builtin_memcpy(&value, columns, sizeof(value));
  return value;
}

template <class W>
KAAMOS_INLINE void put_wide_columns(Column* columns, const W& value) {
  static_assert(sizeof(W) == sizeof(Column) * shape<W>::count);
  __builtin_memcpy(columns, &value, sizeof(value));
}

namespace quad {

// The difference of two lanes of each quad, as wave_results.h has it. In a vector of four lanes,
// `kFirst` and `kSecond` say which lanes each lane subtracts.
template <int kA, int kB, int kC, int kD>
KAAMOS_INLINE simd::Floats chosen(simd::Floats x) {
#ifdef __AVX2__
  return __builtin_shufflevector(x, x, kA, kB, kC, kD, kA + 4, kB + 4, kC + 4, kD + 4);
#else
  return __builtin_shufflevector(x, x, kA, kB, kC, kD);
#endif
}

template <WaveOp kOp>
KAAMOS_INLINE simd::Floats first(simd::Floats x) {
  if constexpr (kOp == WaveOp::kDdxFine) return chosen<0, 0, 2, 2>(x);
  if constexpr (kOp == WaveOp::kDdyFine) return chosen<0, 1, 0, 1>(x);
  return chosen<0, 0, 0, 0>(x);
}
template <WaveOp kOp>
KAAMOS_INLINE simd::Floats second(simd::Floats x) {
  if constexpr (kOp == WaveOp::kDdxFine) return chosen<1, 1, 3, 3>(x);
  if constexpr (kOp == WaveOp::kDdyFine) return chosen<2, 3, 2, 3>(x);
  if constexpr (kOp == WaveOp::kDdxCoarse) return chosen<1, 1, 1, 1>(x);
  return chosen<2, 2, 2, 2>(x);
}

}  // namespace quad

// A derivative of a wide float or vector of them; 0 where one of the two lanes is not active.
template <WaveOp kOp>
KAAMOS_INLINE wide<float> wide_derivative(const lanes& active, const wide<float>& value) {
  return by_register<float>(
      [](simd::Floats x, simd::Ints on) KAAMOS_INLINE_LAMBDA {
        const simd::Ints both = (simd::Ints)quad::first<kOp>((simd::Floats)on) &
                                (simd::Ints)quad::second<kOp>((simd::Floats)on);
        const simd::Floats difference = quad::second<kOp>(x) - quad::first<kOp>(x);
        return (simd::Floats)((simd::Ints)difference & both);
      },
      value, active);
}
template <WaveOp kOp, int N>
KAAMOS_INLINE vec<wide<float>, N> wide_derivative(const lanes& active,
                                                  const vec<wide<float>, N>& value) {
  vec<wide<float>, N> out;
  unroll<N>([&](int i)
                KAAMOS_INLINE_LAMBDA { out.e[i] = wide_derivative<kOp>(active, value.e[i]); });
  return out;
}

}  // namespace kaamos::shader
