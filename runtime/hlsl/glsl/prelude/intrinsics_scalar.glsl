// SPDX-License-Identifier: MIT
// Component-wise intrinsics; the GLSL counterpart of kaamos/shader/intrinsics_scalar.h. float16 is
// computed in float. `precise` keeps the compiler from rearranging sums whose rounding errors are
// intended.

//@ k_ceil,k_floor,k_sqrt f16 f64 any
$T $NAME($T x) { return $BASE(x); }
//@ k_ceil,k_floor,k_sqrt f32 each
float $NAME(float x) { return $BASE(k_flushed(x)); }
//@ k_trunc f16 f32 any
$T k_trunc($T x) { return trunc(x); }
// Ties round to even.
//@ k_round f16 f32 any
$T k_round($T x) { return roundEven(x); }
// For doubles, lavapipe without AVX-512 (Mesa 25.0, LLVM 15) only gets floor and ceil right.
//@ k_trunc f64 each
double k_trunc(double x) { return x < 0.0LF ? ceil(x) : floor(x); }
//@ k_round f64 each
double k_round(double x) {
  double low = floor(x);
  double part = x - low;
  bool is_odd = low * 0.5LF != floor(low * 0.5LF);
  double rounded = part > 0.5LF || (part == 0.5LF && is_odd) ? low + 1.0LF : low;
  return rounded == 0.0LF ? x * 0.0LF : rounded;  // -0 for negative values
}
//@ k_degrees f32 any
$T k_degrees($T x) { return x * 57.2957795; }
//@ k_radians f32 any
$T k_radians($T x) { return x * 0.0174532925; }
//@ k_degrees f64 any
$T k_degrees($T x) { return x * 57.2957795130823209LF; }
//@ k_radians f64 any
$T k_radians($T x) { return x * 0.0174532925199432958LF; }
//@ k_degrees,k_radians f16 any
$T $NAME($T x) { return $T($NAME($F(x))); }
//@ k_rcp floats any
$T k_rcp($T x) { return $1 / x; }
//@ k_rsqrt f32 f64 any
$T k_rsqrt($T x) { return $1 / sqrt(x); }
//@ k_rsqrt f16 any
$T k_rsqrt($T x) { return $T($F(1) / sqrt($F(x))); }
// NaN gives 0.
//@ k_saturate floats each
$T k_saturate($T x) { return x > $0 ? (x < $1 ? x : $1) : $0; }

// Stays in [0, 1): x - floor(x) of a small negative x would round to 1. Infinities give NaN.
//@ k_frac f32 each
float k_frac(float x) {
  float f = k_flushed(x) - floor(k_flushed(x));
  return f == 1.0 ? uintBitsToFloat(0x3F7FFFFFu) : f;
}
//@ k_frac f16 any
$T k_frac($T x) { return $T(k_frac($F(x))); }
//@ k_frac f64 each
double k_frac(double x) {
  double f = x - floor(x);
  return f == 1.0LF ? 1.0LF - 1.1102230246251565e-16LF : f;
}

//@ k_abs f16 f32 f64 i16 i32 i64 any
$T k_abs($T x) { return abs(x); }
//@ k_abs u16 u32 u64 any
$T k_abs($T x) { return x; }
// NaN and zeros give 0.
//@ k_sign floats i16 i32 i64 each
int k_sign($T x) { return int(x > $0) - int(x < $0); }
//@ k_sign u16 u32 u64 each
int k_sign($T x) { return int(x > $0); }

// If one operand is NaN, the result is the other. [D3D11.3 min, max]
//@ k_min floats each
$T k_min($T x, $T y) { return x < y || isnan(y) ? x : y; }
//@ k_max floats each
$T k_max($T x, $T y) { return x >= y || isnan(y) ? x : y; }
//@ k_min ints any
$T k_min($T x, $T y) { return min(x, y); }
//@ k_max ints any
$T k_max($T x, $T y) { return max(x, y); }
//@ k_clamp ints floats any
$T k_clamp($T x, $T low, $T high) { return k_min(k_max(x, low), high); }

// x * y + z with two roundings, for integers too.
//@ k_mad ints floats any
$T k_mad($T x, $T y, $T z) {
  precise $T sum = x * y + z;
  return sum;
}
//@ k_lerp ints floats any
$T k_lerp($T x, $T y, $T s) {
  precise $T sum = x + s * (y - x);
  return sum;
}
//@ k_step ints floats each
$T k_step($T edge, $T x) { return x < edge ? $0 : $1; }
//@ k_smoothstep f32 f64 each
$T k_smoothstep($T low, $T high, $T x) {
  $T t = k_saturate((x - low) / (high - low));
  return t * t * ($T(3.0) - $T(2.0) * t);
}
//@ k_smoothstep f16 any
$T k_smoothstep($T low, $T high, $T x) { return $T(k_smoothstep($F(low), $F(high), $F(x))); }

// The exact remainder: GLSL's x - y * trunc(x / y) is wrong if the quotient is large.
//@ k_fmod f32 each
float k_fmod(float x, float y) {
  uint a = floatBitsToUint(x) & 0x7FFFFFFFu;
  uint b = floatBitsToUint(y) & 0x7FFFFFFFu;
  if (a >= 0x7F800000u || b > 0x7F800000u || b < 0x800000u) return uintBitsToFloat(0x7FC00000u);
  if (a < b) return k_flushed(x);
  uint exponent = b >> 23;
  uint shift = (a >> 23) - exponent;
  uint divisor = (b & 0x7FFFFFu) | 0x800000u;
  uint rest = ((a & 0x7FFFFFu) | 0x800000u) % divisor;
  while (shift > 0u) {
    uint step = min(shift, 8u);
    rest = (rest << step) % divisor;
    shift -= step;
  }
  uint bits = 0u;
  if (rest != 0u) {
    uint up = 23u - uint(findMSB(rest));
    if (up < exponent) bits = ((rest << up) & 0x7FFFFFu) | (exponent - up) << 23;
  }
  return uintBitsToFloat(bits | (floatBitsToUint(x) & 0x80000000u));
}
//@ k_fmod f16 any
$T k_fmod($T x, $T y) { return $T(k_fmod($F(x), $F(y))); }
//@ k_fmod f64 each
double k_fmod(double x, double y) {
  uint64_t sign = 0x8000000000000000UL & packUint2x32(unpackDouble2x32(x));
  uint64_t a = packUint2x32(unpackDouble2x32(abs(x)));
  uint64_t b = packUint2x32(unpackDouble2x32(abs(y)));
  if (a >= 0x7FF0000000000000UL || b > 0x7FF0000000000000UL || b == 0UL) {
    return packDouble2x32(uvec2(0u, 0x7FF80000u));
  }
  if (a < b) return x;
  const uint64_t kLeading = 0x10000000000000UL, kFraction = 0xFFFFFFFFFFFFFUL;
  uint exponent = max(uint(b >> 52), 1u);
  uint shift = max(uint(a >> 52), 1u) - exponent;
  uint64_t divisor = (b & kFraction) | (b > kFraction ? kLeading : 0UL);
  uint64_t rest = ((a & kFraction) | (a > kFraction ? kLeading : 0UL)) % divisor;
  while (shift > 0u) {
    uint step = min(shift, 11u);
    rest = (rest << step) % divisor;
    shift -= step;
  }
  while (rest != 0UL && rest < kLeading && exponent > 1u) {
    rest <<= 1;
    --exponent;
  }
  if (rest >= kLeading) rest = (rest & kFraction) | uint64_t(exponent) << 52;
  return packDouble2x32(unpackUint2x32(rest | sign));
}

// Zero, infinities and NaN are their own mantissa, with exponent 0.
//@ k_frexp_mantissa f32 each
float k_frexp_mantissa(float x) {
  uint magnitude = floatBitsToUint(x) & 0x7FFFFFFFu;
  if (magnitude < 0x800000u) return 0.0;
  return uintBitsToFloat(0x3F000000u | (magnitude & 0x7FFFFFu));
}
//@ k_frexp_exponent f32 each
float k_frexp_exponent(float x) {
  uint magnitude = floatBitsToUint(x) & 0x7FFFFFFFu;
  if (magnitude < 0x800000u) return 0.0;
  return float(int(magnitude >> 23) - 126);
}
//@ k_frexp_mantissa f64 each
double k_frexp_mantissa(double x) {
  if (x == 0.0LF || isnan(x) || isinf(x)) return abs(x);
  int exponent;
  return abs(frexp(x, exponent));
}
//@ k_frexp_exponent f64 each
double k_frexp_exponent(double x) {
  if (x == 0.0LF || isnan(x) || isinf(x)) return 0.0LF;
  int exponent;
  frexp(x, exponent);
  return double(exponent);
}
//@ k_frexp_mantissa,k_frexp_exponent f16 any
$T $NAME($T x) { return $T($NAME($F(x))); }
//@ k_modf_integer floats any
$T k_modf_integer($T x) { return k_trunc(x); }
//@ k_modf_fraction floats any
$T k_modf_fraction($T x) { return x - k_trunc(x); }
//@ k_modf_integer ints any
$T k_modf_integer($T x) { return x; }
//@ k_modf_fraction ints any
$T k_modf_fraction($T x) { return $0; }

// x * y + z rounded once, even on drivers whose fma() is a product and a sum. The product is exact
// as a sum of two doubles; the second-to-last addition rounds to odd. [Boldo and Melquiond 2008]
//@ k_two_sum f64
dvec2 k_two_sum(double a, double b) {
  precise double sum = a + b;
  precise double part = sum - a;
  precise double error = (a - (sum - part)) + (b - part);
  return dvec2(sum, error);
}
//@ k_with_exponent
double k_with_exponent(double x, int exponent) {
  uvec2 bits = unpackDouble2x32(x);
  bits.y = (bits.y & 0x800FFFFFu) | uint(exponent + 1023) << 20;
  return packDouble2x32(bits);
}
//@ k_exponent
int k_exponent(double x) { return int(unpackDouble2x32(x).y >> 20 & 0x7FFu) - 1023; }
//@ k_product_rest
double k_product_rest(double a, double b, double product) {
  precise double a_high = 134217729.0LF * a - (134217729.0LF * a - a);
  precise double b_high = 134217729.0LF * b - (134217729.0LF * b - b);
  precise double a_low = a - a_high, b_low = b - b_high;
  precise double rest = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) +
                        a_low * b_low;
  return rest;
}
//@ k_fma f64 each
double k_fma(double x, double y, double z) {
  int ex = k_exponent(x), ey = k_exponent(y), ez = k_exponent(z);
  if (max(ex, ey) > 1023 || min(ex, ey) < -1022) return x * y + z;
  if (ez > 1023) return z;
  if (z == 0.0LF) return x * y;
  // Exponents are moved near 0, so that no intermediate result is out of range.
  int scale = ex + ey;
  if (ez - scale > 110) return z;
  precise double a = k_with_exponent(x, 0), b = k_with_exponent(y, 0);
  precise double c = k_with_exponent(z, max(ez - scale, -110));
  precise double product = a * b;
  dvec2 low = k_two_sum(c, k_product_rest(a, b, product));
  dvec2 high = k_two_sum(product, low.x);
  dvec2 tail = k_two_sum(low.y, high.y);
  uint64_t bits = packUint2x32(unpackDouble2x32(tail.x));
  if (tail.y != 0.0LF && (bits & 1UL) == 0UL) {
    bits += (tail.y > 0.0LF) == (tail.x > 0.0LF) ? 1UL : ~0UL;
  }
  precise double sum = high.x + packDouble2x32(unpackUint2x32(bits));
  int half_scale = clamp(scale, -2000, 2000) / 2;
  return sum * k_with_exponent(1.0LF, half_scale) *
         k_with_exponent(1.0LF, clamp(scale - half_scale, -1022, 1023));
}
