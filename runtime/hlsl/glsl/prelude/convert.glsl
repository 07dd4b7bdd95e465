// SPDX-License-Identifier: MIT
// Conversions between scalar kinds, component by component; the GLSL counterpart of
// kaamos/shader/convert.h. Integers wrap. Floating point to integer truncates; NaN gives 0, and
// out-of-range values the nearest limit [D3D11.3 ftoi, ftou]. Narrower floats are rounded to
// nearest even.

// A component of a pixel shader's output, for a target whose component has that many bits. 0: as it
// is; 128: SNORM.
//@ k_target
float k_target(float value, uint bits) {
  if (bits == 0u) return value;
  if (bits == 128u) return isnan(value) ? 0.0 : clamp(value, -1.0, 1.0);
  float most = float((1u << bits) - 1u);
  float inside = value > 0.0 ? min(value, 1.0) : 0.0;  // not a number: 0
  // The middle of what drivers turn into this step, be it that they round value * most or truncate
  // value * (most + 1).
  return (floor(inside * most + 0.5) + 0.5) / (most + 1.0);
}
uint k_target(uint value, uint bits) {
  return bits == 0u || bits > 31u ? value : min(value, (1u << bits) - 1u);
}
int k_target(int value, uint bits) {
  if (bits == 0u || bits > 31u) return value;
  return clamp(value, -(1 << (bits - 1u)), (1 << (bits - 1u)) - 1);
}
//@ k_to_bool b each
bool k_to_bool(bool x) { return x; }
//@ k_to_bool ints floats each
bool k_to_bool($T x) { return x != $0; }

//@ k_to_i16 b ints any
$i16 k_to_i16($T x) { return $i16(x); }
//@ k_to_u16 b ints any
$u16 k_to_u16($T x) { return $u16(x); }
//@ k_to_i32 b ints any
$I k_to_i32($T x) { return $I(x); }
//@ k_to_u32 b ints any
$U k_to_u32($T x) { return $U(x); }
//@ k_to_i64 b ints any
$i64 k_to_i64($T x) { return $i64(x); }
//@ k_to_u64 b ints any
$u64 k_to_u64($T x) { return $u64(x); }

//@ k_to_i32 f32 f64 each
int k_to_i32($T x) {
  if (isnan(x)) return 0;
  return x >= $T(2147483648.0) ? 0x7FFFFFFF : x < $T(-2147483648.0) ? ~0x7FFFFFFF : int(x);
}
//@ k_to_u32 f32 f64 each
uint k_to_u32($T x) {
  if (!(x > $0)) return 0u;
  return x >= $T(4294967296.0) ? 0xFFFFFFFFu : uint(x);
}
//@ k_to_i16 f32 f64 each
int16_t k_to_i16($T x) {
  if (isnan(x)) return int16_t(0);
  return int16_t(x >= $T(32767.0) ? 32767 : x <= $T(-32768.0) ? -32768 : int(x));
}
//@ k_to_u16 f32 f64 each
uint16_t k_to_u16($T x) {
  if (!(x > $0)) return uint16_t(0);
  return uint16_t(x >= $T(65535.0) ? 65535u : uint(x));
}
//@ k_to_i64 f32 f64 each
int64_t k_to_i64($T x) {
  if (isnan(x)) return 0L;
  return x >= $T(9223372036854775808.0) ? 0x7FFFFFFFFFFFFFFFL
         : x < $T(-9223372036854775808.0) ? ~0x7FFFFFFFFFFFFFFFL : int64_t(x);
}
//@ k_to_u64 f32 f64 each
uint64_t k_to_u64($T x) {
  if (!(x > $0)) return 0UL;
  return x >= $T(18446744073709551616.0) ? ~0UL : uint64_t(x);
}
//@ k_to_i16 f16 any
$i16 k_to_i16($T x) { return k_to_i16($F(x)); }
//@ k_to_u16 f16 any
$u16 k_to_u16($T x) { return k_to_u16($F(x)); }
//@ k_to_i32 f16 any
$I k_to_i32($T x) { return k_to_i32($F(x)); }
//@ k_to_u32 f16 any
$U k_to_u32($T x) { return k_to_u32($F(x)); }
//@ k_to_i64 f16 any
$i64 k_to_i64($T x) { return k_to_i64($F(x)); }
//@ k_to_u64 f16 any
$u64 k_to_u64($T x) { return k_to_u64($F(x)); }

//@ k_to_f32 b ints floats any
$F k_to_f32($T x) { return $F(x); }
//@ k_to_f64 b ints floats any
$f64 k_to_f64($T x) { return $f64(x); }
//@ k_to_f16 b f16 f32 any
$f16 k_to_f16($T x) { return $f16(x); }
//@ k_to_f16 ints any
$f16 k_to_f16($T x) { return $f16($F(x)); }
// Toward zero, so that what is finite stays finite. [D3D11.3 3.2.2]
//@ k_texel_to_f16 f32 each
float16_t k_texel_to_f16(float x) {
  uint bits = floatBitsToUint(x);
  uint sign = bits >> 16 & 0x8000u;
  uint magnitude = bits & 0x7FFFFFFFu;
  uint rounded = magnitude > 0x7F800000u ? 0x7E00u | (magnitude >> 13 & 0x3FFu)
                 : magnitude == 0x7F800000u ? 0x7C00u
                 : magnitude >= 0x477FE000u ? 0x7BFFu
                 : magnitude >= 0x38800000u ? (magnitude - 0x38000000u) >> 13
                                            : uint(uintBitsToFloat(magnitude) * 16777216.0);
  return unpackFloat2x16(sign | rounded).x;
}
// Goes through a float that is rounded to odd, because rounding to nearest twice is not the same as
// once.
//@ k_to_f16 f64 each
float16_t k_to_f16(double x) {
  float nearest = float(x);
  double back = double(nearest);
  if (isnan(x) || isinf(nearest) || back == x) return float16_t(nearest);
  uint bits = floatBitsToUint(nearest);
  if (abs(back) > abs(x)) --bits;
  return float16_t(uintBitsToFloat(bits | 1u));
}
