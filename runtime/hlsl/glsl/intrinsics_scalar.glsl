// SPDX-License-Identifier: MIT
// Component-wise intrinsics; the twin of kaamos/shader/intrinsics_scalar.h. float16 is computed in
// float. `precise` keeps a compiler from rearranging sums whose rounding errors are planned.

//@ k_ceil,k_floor,k_sqrt,k_trunc floats any
$T $NAME($T x) { return $BASE(x); }
// Halves go to even.
//@ k_round floats any
$T k_round($T x) { return roundEven(x); }
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

// In [0, 1): x - floor(x) of a small negative x would round to 1. Infinities give NaN.
//@ k_frac f32 each
float k_frac(float x) {
  float f = x - floor(x);
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

// A NaN operand gives the other one. [D3D11.3 min, max]
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

// x * y + z with two roundings, integers too.
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
$T k_step($T edge, $T x) { return x >= edge ? $1 : $0; }
//@ k_smoothstep f32 f64 each
$T k_smoothstep($T low, $T high, $T x) {
  $T t = k_saturate((x - low) / (high - low));
  return t * t * ($T(3.0) - $T(2.0) * t);
}
//@ k_smoothstep f16 any
$T k_smoothstep($T low, $T high, $T x) { return $T(k_smoothstep($F(low), $F(high), $F(x))); }

// The exact remainder: GLSL has x - y * trunc(x / y), which is wrong where the quotient is large.
//@ k_fmod f32 each
float k_fmod(float x, float y) {
  uint a = floatBitsToUint(x) & 0x7FFFFFFFu;
  uint b = floatBitsToUint(y) & 0x7FFFFFFFu;
  if (a >= 0x7F800000u || b > 0x7F800000u || b == 0u) return uintBitsToFloat(0x7FC00000u);
  if (a < b) return x;
  uint exponent = max(b >> 23, 1u);
  uint shift = max(a >> 23, 1u) - exponent;
  uint divisor = (b & 0x7FFFFFu) | (b > 0x7FFFFFu ? 0x800000u : 0u);
  uint rest = ((a & 0x7FFFFFu) | (a > 0x7FFFFFu ? 0x800000u : 0u)) % divisor;
  while (shift > 0u) {
    uint step = min(shift, 8u);
    rest = (rest << step) % divisor;
    shift -= step;
  }
  uint bits = 0u;
  if (rest != 0u) {
    uint up = 23u - uint(findMSB(rest));
    bits = up < exponent ? ((rest << up) & 0x7FFFFFu) | (exponent - up) << 23
                         : rest << (exponent - 1u);
  }
  return uintBitsToFloat(bits | (floatBitsToUint(x) & 0x80000000u));
}
//@ k_fmod f16 any
$T k_fmod($T x, $T y) { return $T(k_fmod($F(x), $F(y))); }
//@ k_fmod f64 each
double k_fmod(double x, double y) { return x - y * trunc(x / y); }

// Zero, infinities and NaN are their own mantissa with exponent 0.
//@ k_frexp_mantissa f32 each
float k_frexp_mantissa(float x) {
  uint bits = floatBitsToUint(x);
  uint magnitude = bits & 0x7FFFFFFFu;
  if (magnitude == 0u || magnitude >= 0x7F800000u) return x;
  if (magnitude < 0x800000u) magnitude <<= 23u - uint(findMSB(magnitude));
  return uintBitsToFloat((bits & 0x80000000u) | 0x3F000000u | (magnitude & 0x7FFFFFu));
}
//@ k_frexp_exponent f32 each
float k_frexp_exponent(float x) {
  uint magnitude = floatBitsToUint(x) & 0x7FFFFFFFu;
  if (magnitude == 0u || magnitude >= 0x7F800000u) return 0.0;
  if (magnitude < 0x800000u) return float(findMSB(magnitude) - 148);
  return float(int(magnitude >> 23) - 126);
}
//@ k_frexp_mantissa f64 each
double k_frexp_mantissa(double x) {
  if (x == 0.0LF || isnan(x) || isinf(x)) return x;
  int exponent;
  return frexp(x, exponent);
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
$T k_modf_integer($T x) { return trunc(x); }
//@ k_modf_fraction floats any
$T k_modf_fraction($T x) { return x - trunc(x); }
//@ k_modf_integer ints any
$T k_modf_integer($T x) { return x; }
//@ k_modf_fraction ints any
$T k_modf_fraction($T x) { return $0; }

// Rounded once.
//@ k_fma floats any
$T k_fma($T x, $T y, $T z) { return fma(x, y, z); }
