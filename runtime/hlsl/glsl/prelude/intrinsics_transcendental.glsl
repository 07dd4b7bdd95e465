// SPDX-License-Identifier: MIT
// Elementary functions of float to about one unit in the last place; drivers are allowed a far
// larger error, and differ. Each is a range reduction, then a minimax polynomial for the relative
// error.

// x * 2^n for any integer n; rounds once if the result is a denormal number.
//@ k_scaled f32
float k_scaled(float x, int n) {
  int n1 = clamp(n, -126, 126);
  int n2 = clamp(n - n1, -126, 126);
  return x * uintBitsToFloat(uint(n1 + 127) << 23) * uintBitsToFloat(uint(n2 + 127) << 23) *
         uintBitsToFloat(uint(clamp(n - n1 - n2, -126, 126) + 127) << 23);
}
// HLSL's exponent is a float and may have a fraction.
//@ k_ldexp f32 each
float k_ldexp(float x, float e) {
  if (trunc(e) == e && abs(e) < 1000.0) return k_flushed(k_scaled(k_flushed(x), int(e)));
  return k_flushed(x * k_exp2(e));
}
//@ k_ldexp f64 each
double k_ldexp(double x, double e) {
  if (trunc(e) == e && abs(e) < 10000.0LF) return ldexp(x, int(e));
  return x * double(k_exp2(float(e)));
}

//@ k_exp2 f32 each
float k_exp2(float x) {
  if (isnan(x)) return x;
  if (x >= 128.0) return uintBitsToFloat(0x7F800000u);
  if (x < -150.0) return 0.0;
  precise float n = roundEven(x);
  precise float f = x - n;
  precise float p = 1.0 + f * (0.693147208 + f * (0.240226513 + f * (0.0555032426 +
                    f * (0.00961800344 + f * (0.0013401654 + f * 0.000154765609)))));
  return k_flushed(k_scaled(p, int(n)));
}
//@ k_exp f32 each
float k_exp(float x) {
  if (isnan(x)) return x;
  if (x > 89.0) return uintBitsToFloat(0x7F800000u);
  if (x < -104.0) return 0.0;
  precise float n = roundEven(x * 1.44269504);
  precise float f = (x - n * 0.693359375) + n * 2.12194440e-4;
  precise float p = 1.0 + (f + f * f * (0.50000001 + f * (0.166665129 + f * (0.0416661873 +
                    f * (0.00836959877 + f * 0.00139517135)))));
  return k_flushed(k_scaled(p, int(n)));
}

// x = 2^exponent * (1 + f), 1 + f in [sqrt(1/2), sqrt(2)]; x is a positive normal number.
//@ k_log_parts f32
float k_log_parts(float x, out float exponent) {
  uint bits = floatBitsToUint(x);
  // 0x3F3504F3 is sqrt(1/2).
  int e = (int(bits) - 0x3F3504F3) >> 23;
  exponent = float(e);
  return uintBitsToFloat(uint(int(bits) - (e << 23))) - 1.0;
}
// log(1 + f) = f + rest, where rest is small compared with f.
//@ k_log_rest f32
float k_log_rest(float f) {
  precise float p = 0.333333106 + f * (-0.250000069 + f * (0.200022664 + f * (-0.166682839 +
                    f * (0.142165272 + f * (-0.123980215 + f * (0.119042895 +
                    f * (-0.117316579 + f * 0.0677912277)))))));
  precise float rest = f * f * f * p - 0.5 * f * f;
  return rest;
}
// The value of the logarithms at the edges of their domain; 0 if x is inside.
//@ k_log_edge f32
float k_log_edge(float x) {
  uint bits = floatBitsToUint(x);
  if (bits > 0x7FFFFFu && bits < 0x7F800000u) return 0.0;
  if ((bits & 0x7F800000u) == 0u) return uintBitsToFloat(0xFF800000u);
  return bits == 0x7F800000u ? x : uintBitsToFloat(0x7FC00000u);
}
//@ k_log f32 each
float k_log(float x) {
  float edge = k_log_edge(x);
  if (edge != 0.0) return edge;
  float e;
  precise float f = k_log_parts(x, e);
  precise float sum = e * 0.693359375 + (f + (k_log_rest(f) - e * 2.12194440e-4));
  return sum;
}
//@ k_log2 f32 each
float k_log2(float x) {
  float edge = k_log_edge(x);
  if (edge != 0.0) return edge;
  float e;
  precise float f = k_log_parts(x, e);
  precise float rest = k_log_rest(f);
  // log2(e) is 1 + 0.442695...
  precise float sum = e + (f + (rest + (rest * 0.442695041 + f * 0.442695041)));
  return sum;
}
//@ k_log10 f32 each
float k_log10(float x) {
  float edge = k_log_edge(x);
  if (edge != 0.0) return edge;
  float e;
  precise float f = k_log_parts(x, e);
  precise float rest = k_log_rest(f);
  // 0.30078125 and 0.43359375 are log10(2) and log10(e) to a few bits, so that products with them
  // are exact.
  precise float high = e * 0.30078125;
  precise float sum = high + ((e * 2.48745664e-4 + (f + rest) * 7.00731903e-4) +
                              (rest * 0.43359375 + f * 0.43359375));
  return sum;
}

// x = (quadrant + r * 2 / pi) quadrants, r in [-pi/4, pi/4]; x is finite.
//@ k_quadrant f32
float k_quadrant(float x, out int quadrant) {
  uint bits = floatBitsToUint(x) & 0x7FFFFFFFu;
  if (bits < 0x42000000u) {  // 32
    precise float n = roundEven(x * 0.636619772);
    quadrant = int(n);
    precise float r = ((x - n * 1.5703125) - n * 4.837512969970703125e-4) -
                      n * 7.54978995489188216e-8;
    return r;
  }
  // 2 / pi as a fraction in 32-bit words. Only the part of the product with the mantissa that is
  // below four quadrants matters: 64 bits, starting at a place given by the exponent.
  const uint kTwoOverPi[7] = uint[7](0u, 0xA2F9836Eu, 0x4E441529u, 0xFC2757D1u, 0xF534DDC0u,
                                     0xDB629599u, 0x3C439041u);
  uint mantissa = (bits & 0x7FFFFFu) | 0x800000u;
  uint skip = (bits >> 23) - 127u - 23u + 30u;  // bits of the fraction to drop, led by 32 zeros
  uint word = skip >> 5, shift = skip & 31u;
  uint a = kTwoOverPi[word], b = kTwoOverPi[word + 1u], c = kTwoOverPi[word + 2u];
  uint d = word + 3u < 7u ? kTwoOverPi[word + 3u] : 0u;
  if (shift > 0u) {
    a = a << shift | b >> (32u - shift);
    b = b << shift | c >> (32u - shift);
    c = c << shift | d >> (32u - shift);
  }
  uint64_t product = (uint64_t(a * mantissa) << 32) + uint64_t(b) * mantissa +
                     ((uint64_t(c) * mantissa) >> 32);
  // Two bits of quadrants and 62 of fraction.
  uint64_t rounded = product + 0x2000000000000000UL;
  quadrant = int(uint(rounded >> 62));
  int64_t fraction = int64_t(product - (uint64_t(quadrant) << 62));
  // Near 0 the digits of the fraction start further down.
  uint64_t magnitude = uint64_t(abs(fraction));
  uvec2 halves = unpackUint2x32(magnitude);
  int top = halves.y != 0u ? 32 + findMSB(halves.y) : findMSB(halves.x);
  int drop = max(top - 30, 0);
  float r = float(uint(magnitude >> drop)) * uintBitsToFloat(uint(drop + 65) << 23);  // 2^(drop-62)
  r *= 1.57079633;
  if (fraction < 0L) r = -r;
  if (floatBitsToUint(x) > 0x7FFFFFFFu) {
    r = -r;
    quadrant = -quadrant;
  }
  return r;
}
//@ k_sin_near f32
float k_sin_near(float r) {
  precise float z = r * r;
  precise float s = r + r * z * (-0.166666666 + z * (0.00833332918 +
                    z * (-0.000198392728 + z * 2.71774576e-06)));
  return s;
}
//@ k_cos_near f32
float k_cos_near(float r) {
  precise float z = r * r;
  precise float c = 1.0 - (0.5 * z - z * z * (0.0416666666 + z * (-0.00138888836 +
                    z * (2.47994787e-05 + z * -2.72067973e-07))));
  return c;
}
// Infinities have no sine; zeros keep their sign. This is decided at the end, because on lavapipe
// an early return costs more than it saves.
//@ k_periodic_edge
float k_periodic_edge(float x, float result, float at_zero) {
  result = (floatBitsToUint(x) & 0x7F800000u) == 0u ? k_flushed(at_zero) : result;
  return (floatBitsToUint(x) & 0x7FFFFFFFu) >= 0x7F800000u ? uintBitsToFloat(0x7FC00000u) : result;
}
//@ k_sin f32 each
float k_sin(float x) {
  int quadrant;
  float r = k_quadrant(x, quadrant);
  float s = (quadrant & 1) != 0 ? k_cos_near(r) : k_sin_near(r);
  return k_periodic_edge(x, (quadrant & 2) != 0 ? -s : s, x);
}
//@ k_cos f32 each
float k_cos(float x) {
  int quadrant;
  float r = k_quadrant(x, quadrant);
  float c = (quadrant & 1) != 0 ? k_sin_near(r) : k_cos_near(r);
  return k_periodic_edge(x, (quadrant + 1 & 2) != 0 ? -c : c, 1.0);
}
//@ k_tan f32 each
float k_tan(float x) {
  int quadrant;
  float r = k_quadrant(x, quadrant);
  precise float z = r * r;
  precise float t = r + r * z * (0.333331439 + z * (0.133391413 + z * (0.0533824997 +
                    z * (0.0245344082 + z * (0.00295033402 + z * 0.00948707541)))));
  return k_periodic_edge(x, (quadrant & 1) != 0 ? -1.0 / t : t, x);
}

// For |x| <= 1/2.
//@ k_asin_near f32
float k_asin_near(float x) {
  precise float z = x * x;
  precise float s = x + x * z * (0.166667535 + z * (0.0749525355 + z * (0.0454763977 +
                    z * (0.0241474741 + z * 0.0422244747))));
  return s;
}
//@ k_asin f32 each
float k_asin(float x) {
  float a = abs(x);
  if (!(a <= 1.0)) return uintBitsToFloat(0x7FC00000u);
  if (a <= 0.5) return k_flushed(x) == 0.0 ? k_flushed(x) : k_asin_near(x);
  precise float r = 1.57079633 - (2.0 * k_asin_near(sqrt(0.5 * (1.0 - a))) + 4.37113883e-8);
  return x < 0.0 ? -r : r;
}
//@ k_acos f32 each
float k_acos(float x) {
  float a = abs(x);
  if (!(a <= 1.0)) return uintBitsToFloat(0x7FC00000u);
  precise float near = a <= 0.5 ? k_asin_near(x) : 2.0 * k_asin_near(sqrt(0.5 * (1.0 - a)));
  if (a > 0.5 && x > 0.0) return near;
  precise float high = a > 0.5 ? 3.14159274 : 1.57079637;
  precise float low = a > 0.5 ? 8.74227766e-8 : 4.37113883e-8;
  precise float r = high - (near + low);
  return r;
}
//@ k_atan f32 each
float k_atan(float x) {
  if (isnan(x) || k_flushed(x) == 0.0) return k_flushed(x);
  float a = abs(x);
  precise float base = 0.0, low = 0.0, y = a;
  if (a > 2.41421366) {
    base = 1.57079637, low = -4.37113883e-8, y = -1.0 / a;
  } else if (a > 0.414213568) {
    base = 0.785398185, low = -2.18556941e-8, y = (a - 1.0) / (a + 1.0);
  }
  precise float z = y * y;
  precise float r = base + (y + (low + y * z * (-0.333333143 + z * (0.199984156 +
                    z * (-0.142424135 + z * (0.105851096 + z * -0.0605519213))))));
  return x < 0.0 ? -r : r;
}
//@ k_atan2 f32 each
float k_atan2(float y, float x) {
  if (isnan(x) || isnan(y)) return uintBitsToFloat(0x7FC00000u);
  float ax = abs(k_flushed(x)), ay = abs(k_flushed(y));
  bool left = floatBitsToUint(x) > 0x7FFFFFFFu;
  // Zeros of x have no sign, and those of y have none where x is negative. [DXC: TranslateAtan2]
  bool unsigned_zero = ay == 0.0 && (left || ax == 0.0);
  precise float r;
  if (isinf(ax) && isinf(ay)) {
    r = left ? 2.35619450 : 0.785398185;
  } else if (isinf(ay) || ax == 0.0) {
    r = 1.57079637;
  } else if (ay == 0.0) {
    r = left ? 3.14159274 : 0.0;
  } else {
    // Divides so that the quotient is at most 1 and nothing overflows.
    precise float near = k_atan(min(ax, ay) / max(ax, ay));
    if (ay > ax) {
      r = left ? 1.57079637 + (near - 4.37113883e-8) : 1.57079637 - (near + 4.37113883e-8);
    } else {
      r = left ? 3.14159274 - (near + 8.74227766e-8) : near;
    }
  }
  return floatBitsToUint(y) > 0x7FFFFFFFu && !unsigned_zero ? -r : r;
}

// Half of e^a, which overflows later than e^a does.
//@ k_half_exp f32
float k_half_exp(float a) {
  if (a < 85.0) return 0.5 * k_exp(a);
  float root = k_exp(0.5 * a);
  return (0.5 * root) * root;
}
//@ k_sinh f32 each
float k_sinh(float x) {
  if (isnan(x) || k_flushed(x) == 0.0) return k_flushed(x);
  float a = abs(x);
  if (a <= 1.0) {
    precise float z = x * x;
    precise float s = x + x * z * (0.166666665 + z * (0.00833335056 + z * (0.000198360574 +
                      z * 2.81756439e-06)));
    return s;
  }
  float half_exp = k_half_exp(a);
  float s = half_exp - 0.25 / half_exp;
  return x < 0.0 ? -s : s;
}
//@ k_cosh f32 each
float k_cosh(float x) {
  float a = abs(x);
  if (isnan(x)) return x;
  float half_exp = k_half_exp(a);
  return half_exp + 0.25 / half_exp;
}
//@ k_tanh f32 each
float k_tanh(float x) {
  if (isnan(x) || k_flushed(x) == 0.0) return k_flushed(x);
  float a = abs(x);
  if (a < 0.625) {
    precise float z = x * x;
    precise float t = x + x * z * (-0.333333305 + z * (0.133331916 + z * (-0.0539448889 +
                      z * (0.021690154 + z * (-0.00815069726 + z * 0.00211801708)))));
    return t;
  }
  float t = a > 10.0 ? 1.0 : 1.0 - 2.0 / (k_exp(2.0 * a) + 1.0);
  return x < 0.0 ? -t : t;
}

// HLSL's pow is exp2(y * log2(x)): NaN for a negative x, whatever y is. The product has up to 7
// bits before the point, so the logarithm is kept as a sum of two floats.
//@ k_pow f32 each
float k_pow(float x, float y) {
  if (isnan(y) || !(x >= 0.0)) return uintBitsToFloat(0x7FC00000u);
  float edge = k_log_edge(abs(x));
  if (k_flushed(y) == 0.0) return edge == 0.0 ? 1.0 : uintBitsToFloat(0x7FC00000u);
  if (x == 1.0) return isinf(y) ? uintBitsToFloat(0x7FC00000u) : 1.0;
  if (edge != 0.0) return (edge > 0.0) == (y > 0.0) ? uintBitsToFloat(0x7F800000u) : 0.0;
  if (isinf(y)) return (x > 1.0) == (y > 0.0) ? y * y : 0.0;
  float e;
  precise float f = k_log_parts(x, e);
  // log(1 + f) = 2 s + s^3 P(s^2), s = f / (2 + f) as high + low; products of halves are exact.
  precise float d = 2.0 + f;
  precise float d_low = f - (d - 2.0);
  precise float s = f / d;
  precise float s_high = uintBitsToFloat(floatBitsToUint(s) & 0xFFFFF000u);
  precise float d_high = uintBitsToFloat(floatBitsToUint(d) & 0xFFFFF000u);
  precise float s_low = (((f - s_high * d_high) - s_high * ((d - d_high) + d_low))) / d;
  precise float z = s * s;
  precise float tail = s * z * (0.666666656 + z * (0.400003562 + z * (0.285358851 +
                       z * 0.236106221)));
  // log2(e) = 1.4423828125 + 0.000312228389
  precise float n_high = 2.0 * s_high * 1.4423828125;
  precise float n_low = (2.0 * s_low + tail) * 1.44269504 + 2.0 * s_high * 3.12228389e-4;
  precise float sum = e + n_high;
  precise float sum_low = (abs(e) >= abs(n_high) ? n_high - (sum - e) : e - (sum - n_high)) + n_low;
  precise float log_high = uintBitsToFloat(floatBitsToUint(sum) & 0xFFFFF000u);
  precise float log_low = sum - log_high + sum_low;
  precise float y_high = uintBitsToFloat(floatBitsToUint(y) & 0xFFFFF000u);
  precise float p_high = y_high * log_high;
  precise float p_low = (y - y_high) * log_high + y * log_low;
  if (!(abs(p_high) < 200.0)) return p_high > 0.0 ? uintBitsToFloat(0x7F800000u) : 0.0;
  precise float n = roundEven(p_high);
  precise float g = (p_high - n) + p_low;
  // g may slightly exceed the polynomial's range if p_low is large.
  precise float more = roundEven(g);
  g -= more;
  precise float p = 1.0 + g * (0.693147208 + g * (0.240226513 + g * (0.0555032426 +
                    g * (0.00961800344 + g * (0.0013401654 + g * 0.000154765609)))));
  return k_flushed(k_scaled(p, int(n + more)));
}

// The other types are computed in float.
//@ k_acos,k_asin,k_atan,k_cos,k_cosh,k_exp,k_exp2,k_log,k_log10,k_log2,k_sin,k_sinh,k_tan,k_tanh f16 f64 any
$T $NAME($T x) { return $T($NAME($F(x))); }
//@ k_atan2,k_ldexp,k_pow f16 any
$T $NAME($T x, $T y) { return $T($NAME($F(x), $F(y))); }
//@ k_atan2,k_pow f64 any
$T $NAME($T x, $T y) { return $T($NAME($F(x), $F(y))); }
