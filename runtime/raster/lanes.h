// SPDX-License-Identifier: MIT
//
// Eight pixels side by side: a block of 4 x 2 pixels, or two quads of 2 x 2, in the order of
// pixel shaders. What includes this is compiled once for any processor and once for AVX2, into
// namespaces of different names, with the same results.
#pragma once

#include <cstdint>

#include "kaamos/shader/wide.h"

#ifdef __AVX2__
#define KAAMOS_RASTER_LEVEL avx2
#else
#define KAAMOS_RASTER_LEVEL baseline
#endif

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

using shader::bits_of;
using shader::by_register;
using shader::lanes;
using shader::wide;
namespace simd = shader::simd;

using Floats8 = wide<float>;
using Ints8 = wide<int32_t>;

// A register in memory, anywhere. Copies of its bytes would go through the stack in halves, which a
// load of the whole then has to wait for.
template <class T>
using InMemory [[gnu::vector_size(simd::kRegisterBytes), gnu::aligned(4), gnu::may_alias]] = T;

template <class T>
KAAMOS_INLINE wide<T> load(const void* from) {
  const auto* registers = static_cast<const InMemory<T>*>(from);
#ifdef __AVX2__
  return {(simd::Register<T>)registers[0]};
#else
  return {(simd::Register<T>)registers[0], (simd::Register<T>)registers[1]};
#endif
}
template <class T>
KAAMOS_INLINE void store(void* to, const wide<T>& value) {
  auto* registers = static_cast<InMemory<T>*>(to);
  registers[0] = (InMemory<T>)value.a;
#ifndef __AVX2__
  registers[1] = (InMemory<T>)value.b;
#endif
}
template <class T>
KAAMOS_INLINE wide<T> splat(T value) {
  wide<T> out;
  shader::fill_lanes(out, value);
  return out;
}
// One value for each quad.
template <class T>
KAAMOS_INLINE wide<T> splat(T first, T second) {
  simd::Register<T> a = simd::Register<T>{} + first;
#ifdef __AVX2__
  const simd::Register<T> b = simd::Register<T>{} + second;
  return {__builtin_shufflevector(a, b, 0, 1, 2, 3, 12, 13, 14, 15)};
#else
  return {a, simd::Register<T>{} + second};
#endif
}
template <class T>
KAAMOS_INLINE wide<T> operator+(const wide<T>& a, const wide<T>& b) {
  return by_register<T>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x + y; }, a, b);
}
template <class T>
KAAMOS_INLINE wide<T> operator-(const wide<T>& a, const wide<T>& b) {
  return by_register<T>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x - y; }, a, b);
}
template <class T>
KAAMOS_INLINE wide<T> operator*(const wide<T>& a, const wide<T>& b) {
  return by_register<T>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x * y; }, a, b);
}
KAAMOS_INLINE Floats8 operator/(const Floats8& a, const Floats8& b) {
  return by_register<float>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x / y; }, a, b);
}
KAAMOS_INLINE Ints8 operator|(const Ints8& a, const Ints8& b) {
  return by_register<int32_t>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x | y; }, a, b);
}
KAAMOS_INLINE Ints8 operator&(const Ints8& a, const Ints8& b) {
  return by_register<int32_t>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x & y; }, a, b);
}
template <class T>
KAAMOS_INLINE lanes less(const wide<T>& a, const wide<T>& b) {
  return by_register<bool>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x < y; }, a, b);
}
template <class T>
KAAMOS_INLINE lanes less_or_equal(const wide<T>& a, const wide<T>& b) {
  return by_register<bool>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x <= y; }, a, b);
}
template <class T>
KAAMOS_INLINE lanes equal(const wide<T>& a, const wide<T>& b) {
  return by_register<bool>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x == y; }, a, b);
}
// `b` where a comparison with it does not hold, so where `a` is NaN.
KAAMOS_INLINE Floats8 larger(const Floats8& a, const Floats8& b) {
  return by_register<float>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x > y ? x : y; }, a,
                            b);
}
KAAMOS_INLINE Floats8 smaller(const Floats8& a, const Floats8& b) {
  return by_register<float>([](auto x, auto y) KAAMOS_INLINE_LAMBDA { return x < y ? x : y; }, a,
                            b);
}
template <class T>
KAAMOS_INLINE wide<T> choose(const lanes& mask, const wide<T>& a, const wide<T>& b) {
  wide<T> out = b;
  shader::blend(out, a, mask);
  return out;
}
// The lanes whose bits are set.
KAAMOS_INLINE lanes lanes_of(uint32_t bits) {
#ifdef __AVX2__
  const simd::Ints each = {1, 2, 4, 8, 16, 32, 64, 128};
  return {(simd::Ints{} + static_cast<int32_t>(bits) & each) == each};
#else
  const simd::Ints low = {1, 2, 4, 8};
  const simd::Ints high = {16, 32, 64, 128};
  const simd::Ints all = simd::Ints{} + static_cast<int32_t>(bits);
  return {(all & low) == low, (all & high) == high};
#endif
}
KAAMOS_INLINE lanes every_lane_if(bool condition) {
  return by_register<bool>([condition](auto x)
                               KAAMOS_INLINE_LAMBDA { return x - static_cast<int32_t>(condition); },
                           lanes{});
}
// Signs of integers: the lanes that are 0 or more.
KAAMOS_INLINE lanes not_negative(const Ints8& a) {
  return by_register<bool>([](auto x) KAAMOS_INLINE_LAMBDA { return ~(x >> 31); }, a);
}

using IntQuarter [[gnu::vector_size(16)]] = int32_t;
// The first and the last four lanes.
KAAMOS_INLINE IntQuarter low_half(const Ints8& x) {
#ifdef __AVX2__
  return __builtin_shufflevector(x.a, x.a, 0, 1, 2, 3);
#else
  return x.a;
#endif
}
KAAMOS_INLINE IntQuarter high_half(const Ints8& x) {
#ifdef __AVX2__
  return __builtin_shufflevector(x.a, x.a, 4, 5, 6, 7);
#else
  return x.b;
#endif
}

// ---------------------------------------------------------------------------------------------
// Doubles, for what must not round before the end.

using DoubleRegister [[gnu::vector_size(simd::kRegisterBytes)]] = double;
inline constexpr int kDoubleRegisters = 64 / simd::kRegisterBytes;

struct Doubles8 {
  DoubleRegister r[kDoubleRegisters];
};
KAAMOS_INLINE Doubles8 doubles(double value) {
  Doubles8 out;
  for (auto& r : out.r) r = DoubleRegister{} + value;
  return out;
}
// One value for each quad.
KAAMOS_INLINE Doubles8 doubles(double first, double second) {
  Doubles8 out;
  for (int i = 0; i < kDoubleRegisters; ++i) {
    out.r[i] = DoubleRegister{} + (i < kDoubleRegisters / 2 ? first : second);
  }
  return out;
}
KAAMOS_INLINE Doubles8 load_doubles(const double* from) {
  const auto* registers = reinterpret_cast<const InMemory<double>*>(from);
  Doubles8 out;
  for (int i = 0; i < kDoubleRegisters; ++i) out.r[i] = (DoubleRegister)registers[i];
  return out;
}
KAAMOS_INLINE Doubles8 load_ints(const int32_t* from) {
  double values[8];
  for (int i = 0; i < 8; ++i) values[i] = from[i];
  return load_doubles(values);
}
KAAMOS_INLINE Doubles8 operator+(const Doubles8& a, const Doubles8& b) {
  Doubles8 out;
  for (int i = 0; i < kDoubleRegisters; ++i) out.r[i] = a.r[i] + b.r[i];
  return out;
}
KAAMOS_INLINE Doubles8 operator-(const Doubles8& a, const Doubles8& b) {
  Doubles8 out;
  for (int i = 0; i < kDoubleRegisters; ++i) out.r[i] = a.r[i] - b.r[i];
  return out;
}
KAAMOS_INLINE Doubles8 operator*(const Doubles8& a, const Doubles8& b) {
  Doubles8 out;
  for (int i = 0; i < kDoubleRegisters; ++i) out.r[i] = a.r[i] * b.r[i];
  return out;
}

using FloatQuarter [[gnu::vector_size(16)]] = float;
KAAMOS_INLINE Floats8 to_floats(const Doubles8& x) {
#ifdef __AVX2__
  const FloatQuarter low = __builtin_convertvector(x.r[0], FloatQuarter);
  const FloatQuarter high = __builtin_convertvector(x.r[1], FloatQuarter);
  return {__builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7)};
#else
  Floats8 out;
  float values[8];
  for (int i = 0; i < 4; ++i) {
    values[2 * i] = static_cast<float>(x.r[i][0]);
    values[2 * i + 1] = static_cast<float>(x.r[i][1]);
  }
  __builtin_memcpy(&out, values, sizeof(out));
  return out;
#endif
}
// Rounded toward zero; they fit.
KAAMOS_INLINE Ints8 to_ints(const Doubles8& x) {
#ifdef __AVX2__
  const IntQuarter low = __builtin_convertvector(x.r[0], IntQuarter);
  const IntQuarter high = __builtin_convertvector(x.r[1], IntQuarter);
  return {__builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7)};
#else
  Ints8 out;
  int32_t values[8];
  for (int i = 0; i < 4; ++i) {
    values[2 * i] = static_cast<int32_t>(x.r[i][0]);
    values[2 * i + 1] = static_cast<int32_t>(x.r[i][1]);
  }
  __builtin_memcpy(&out, values, sizeof(out));
  return out;
#endif
}
KAAMOS_INLINE Doubles8 to_doubles(const Floats8& x) {
  float values[8];
  __builtin_memcpy(values, &x, sizeof(values));
  double wide_values[8];
  for (int i = 0; i < 8; ++i) wide_values[i] = static_cast<double>(values[i]);
  return load_doubles(wide_values);
}
KAAMOS_INLINE Floats8 to_floats(const Ints8& x) {
  return by_register<float>(
      [](simd::Ints i) KAAMOS_INLINE_LAMBDA { return __builtin_convertvector(i, simd::Floats); },
      x);
}
KAAMOS_INLINE Ints8 to_ints(const Floats8& x) {
  return by_register<int32_t>(
      [](simd::Floats f) KAAMOS_INLINE_LAMBDA { return __builtin_convertvector(f, simd::Ints); },
      x);
}

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
