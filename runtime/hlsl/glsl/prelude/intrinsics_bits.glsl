// SPDX-License-Identifier: MIT
// Intrinsics on bits; the GLSL counterpart of kaamos/shader/intrinsics_bits.h.

//@ k_asfloat i32 any
$F k_asfloat($T x) { return intBitsToFloat(x); }
//@ k_asfloat u32 any
$F k_asfloat($T x) { return uintBitsToFloat(x); }
//@ k_asfloat f32 any
$F k_asfloat($T x) { return x; }
//@ k_asint f32 any
$I k_asint($T x) { return floatBitsToInt(x); }
//@ k_asint i32 u32 any
$I k_asint($T x) { return $I(x); }
//@ k_asuint f32 any
$U k_asuint($T x) { return floatBitsToUint(x); }
//@ k_asuint i32 u32 any
$U k_asuint($T x) { return $U(x); }

//@ k_asfloat16 i16 any
$f16 k_asfloat16($T x) { return int16BitsToFloat16(x); }
//@ k_asfloat16 u16 any
$f16 k_asfloat16($T x) { return uint16BitsToFloat16(x); }
//@ k_asfloat16 f16 any
$T k_asfloat16($T x) { return x; }
//@ k_asint16 f16 any
$i16 k_asint16($T x) { return float16BitsToInt16(x); }
//@ k_asint16 i16 u16 any
$i16 k_asint16($T x) { return $i16(x); }
//@ k_asuint16 f16 any
$u16 k_asuint16($T x) { return float16BitsToUint16(x); }
//@ k_asuint16 i16 u16 any
$u16 k_asuint16($T x) { return $u16(x); }

//@ k_double_from
double k_double_from(uint low, uint high) { return packDouble2x32(uvec2(low, high)); }
//@ k_asdouble u32 scalar
double k_asdouble(uint low, uint high) { return k_double_from(low, high); }
//@ k_asdouble u32 vector
$f64 k_asdouble($T low, $T high) {
  $f64 result;
  for (int i = 0; i < $N; ++i) result[i] = k_double_from(low[i], high[i]);
  return result;
}
//@ k_asuint_low f64 each
uint k_asuint_low(double x) { return unpackDouble2x32(x).x; }
//@ k_asuint_high f64 each
uint k_asuint_high(double x) { return unpackDouble2x32(x).y; }

// Tested by bits, because a compiler may assume that there are no NaNs.
//@ k_isnan f32 each
bool k_isnan(float x) { return (floatBitsToUint(x) & 0x7FFFFFFFu) > 0x7F800000u; }
//@ k_isinf f32 each
bool k_isinf(float x) { return (floatBitsToUint(x) & 0x7FFFFFFFu) == 0x7F800000u; }
//@ k_isfinite f32 each
bool k_isfinite(float x) { return (floatBitsToUint(x) & 0x7FFFFFFFu) < 0x7F800000u; }
//@ k_isnan,k_isinf,k_isfinite f16 any
$B $NAME($T x) { return $NAME($F(x)); }
//@ k_isnan f64 each
bool k_isnan(double x) {
  uvec2 bits = unpackDouble2x32(x);
  uint high = bits.y & 0x7FFFFFFFu;
  return high > 0x7FF00000u || (high == 0x7FF00000u && bits.x != 0u);
}
//@ k_isinf f64 each
bool k_isinf(double x) {
  uvec2 bits = unpackDouble2x32(x);
  return (bits.y & 0x7FFFFFFFu) == 0x7FF00000u && bits.x == 0u;
}
//@ k_isfinite f64 each
bool k_isfinite(double x) { return (unpackDouble2x32(x).y & 0x7FFFFFFFu) < 0x7FF00000u; }
// Neither zero, denormal, infinite nor NaN. A denormal half is a normal float.
//@ k_isnormal f32 each
bool k_isnormal(float x) {
  uint bits = floatBitsToUint(x) & 0x7FFFFFFFu;
  return bits >= 0x00800000u && bits < 0x7F800000u;
}
//@ k_isnormal f16 each
bool k_isnormal(float16_t x) {
  uint bits = floatBitsToUint(float(x)) & 0x7FFFFFFFu;
  return bits >= 0x38800000u && bits < 0x7F800000u;
}
//@ k_isnormal f64 each
bool k_isnormal(double x) {
  uint bits = unpackDouble2x32(x).y & 0x7FFFFFFFu;
  return bits >= 0x00100000u && bits < 0x7FF00000u;
}

//@ k_countbits i32 u32 any
$U k_countbits($T x) { return $U(bitCount(x)); }
//@ k_countbits i16 u16 each
uint k_countbits($T x) { return uint(bitCount(uint(x) & 0xFFFFu)); }
//@ k_countbits i64 u64 each
uint k_countbits($T x) {
  uvec2 halves = unpackUint2x32(uint64_t(x));
  return uint(bitCount(halves.x) + bitCount(halves.y));
}
// 0xFFFFFFFF if there is none; for a negative number, the highest 0 bit.
//@ k_firstbitlow i32 u32 any
$U k_firstbitlow($T x) { return $U(findLSB(x)); }
//@ k_firstbitlow i16 u16 each
uint k_firstbitlow($T x) { return uint(findLSB(uint(x) & 0xFFFFu)); }
//@ k_firstbitlow i64 u64 each
uint k_firstbitlow($T x) {
  uvec2 halves = unpackUint2x32(uint64_t(x));
  if (halves.x != 0u) return uint(findLSB(halves.x));
  return halves.y != 0u ? 32u + uint(findLSB(halves.y)) : ~0u;
}
//@ k_firstbithigh i32 u32 any
$U k_firstbithigh($T x) { return $U(findMSB(x)); }
//@ k_firstbithigh i16 each
uint k_firstbithigh(int16_t x) { return uint(findMSB(int(x))); }
//@ k_firstbithigh u16 each
uint k_firstbithigh(uint16_t x) { return uint(findMSB(uint(x))); }
//@ k_firstbithigh i64 u64 each
uint k_firstbithigh($T x) {
  uvec2 halves = unpackUint2x32(uint64_t(x < $0 ? ~x : x));
  if (halves.y != 0u) return 32u + uint(findMSB(halves.y));
  return halves.x != 0u ? uint(findMSB(halves.x)) : ~0u;
}
//@ k_reversebits i32 u32 any
$T k_reversebits($T x) { return bitfieldReverse(x); }
//@ k_reversebits i16 u16 each
$T k_reversebits($T x) { return $T(bitfieldReverse(uint(x)) >> 16); }
//@ k_reversebits i64 u64 each
$T k_reversebits($T x) {
  return $T(packUint2x32(bitfieldReverse(unpackUint2x32(uint64_t(x)).yx)));
}

// A NaN keeps its sign and the top of its payload, and becomes quiet.
//@ k_f16tof32 u32 each
float k_f16tof32(uint x) {
  uint sign = (x & 0x8000u) << 16;
  uint magnitude = x & 0x7FFFu;
  if (magnitude >= 0x7C00u) {
    uint quiet = magnitude > 0x7C00u ? 0x400000u : 0u;
    return uintBitsToFloat(sign | 0x7F800000u | quiet | (magnitude & 0x3FFu) << 13);
  }
  if (magnitude < 0x400u) {  // a multiple of 2^-24
    return uintBitsToFloat(sign | floatBitsToUint(float(magnitude) * 5.9604644775390625e-8));
  }
  return uintBitsToFloat(sign | ((magnitude << 13) + 0x38000000u));
}
// Rounded to nearest even; overflow gives infinity.
//@ k_f32tof16 f32 each
uint k_f32tof16(float x) {
  uint bits = floatBitsToUint(x);
  uint sign = bits >> 16 & 0x8000u;
  uint magnitude = bits & 0x7FFFFFFFu;
  if (magnitude > 0x7F800000u) return sign | 0x7E00u | (magnitude >> 13 & 0x3FFu);
  if (magnitude >= 0x477FF000u) return sign | 0x7C00u;
  if (magnitude < 0x38800000u) {
    // The sum's last place is 2^-24, the step between half's denormals, so the addition rounds.
    precise float sum = uintBitsToFloat(magnitude) + 0.5;
    return sign | (floatBitsToUint(sum) - 0x3F000000u);
  }
  return sign | (magnitude - 0x38000000u + 0xFFFu + (magnitude >> 13 & 1u)) >> 13;
}

//@ k_any,k_all b vector
bool $NAME($T x) { return $BASE(x); }
//@ k_any,k_all b scalar
bool $NAME($T x) { return x; }
//@ k_any,k_all ints floats scalar
bool $NAME($T x) { return x != $0; }
//@ k_any,k_all ints floats vector
bool $NAME($T x) { return $BASE(notEqual(x, $0)); }

// Sums of absolute differences between the reference's bytes and 4 windows of the source's 8 bytes;
// a reference byte of 0 is masked out.
//@ k_msad4
uvec4 k_msad4(uint reference, uvec2 source, uvec4 accumulator) {
  for (int window = 0; window < 4; ++window) {
    for (int i = 0; i < 4; ++i) {
      int at = window + i;
      int a = int(reference >> 8 * i & 0xFFu);
      int b = int((at < 4 ? source.x >> 8 * at : source.y >> 8 * (at - 4)) & 0xFFu);
      if (a != 0) accumulator[window] += uint(abs(a - b));
    }
  }
  return accumulator;
}
