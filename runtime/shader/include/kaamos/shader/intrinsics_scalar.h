// SPDX-License-Identifier: MIT
//
// Component-wise intrinsics, with the results that D3D requires at the edges of their domains.
// Named as in HLSL; float16 is computed in float. All operands of one call have the same type.
#pragma once

#include "kaamos/shader/convert.h"
#include "kaamos/shader/elementary.h"
#include "kaamos/shader/operators.h"

namespace kaamos::shader {
// ---------------------------------------------------------------------------------------------
// Functions of one floating-point argument: f32 and f64 are expressions in x.

namespace op {
// Only instructions flush it; the C library's floor and ceil work on bits.
KAAMOS_INLINE float rounded_operand(float x) {
#if defined(__SSE4_1__) || defined(__aarch64__)
  return x;
#else
  return flushed(x);
#endif
}
}  // namespace op

#define KAAMOS_FLOAT_FUNCTION(name, f32, f64)                                       \
  namespace op {                                                                    \
  struct name##_function {                                                          \
    KAAMOS_INLINE static float apply(float x) { return f32; }                       \
    KAAMOS_INLINE static double apply(double x) { return f64; }                     \
    KAAMOS_INLINE static half apply(half x) { return to_half(apply(to_float(x))); } \
  };                                                                                \
  }                                                                                 \
  template <class V>                                                                \
  KAAMOS_INLINE V name(const V& x) {                                                \
    return map<op::name##_function>(x);                                             \
  }

KAAMOS_FLOAT_FUNCTION(acos, __builtin_acosf(x), __builtin_acos(x))
KAAMOS_FLOAT_FUNCTION(asin, __builtin_asinf(flushed(x)), __builtin_asin(x))
KAAMOS_FLOAT_FUNCTION(atan, __builtin_atanf(flushed(x)), __builtin_atan(x))
KAAMOS_FLOAT_FUNCTION(ceil, __builtin_ceilf(rounded_operand(x)), __builtin_ceil(x))
KAAMOS_FLOAT_FUNCTION(cos, cosine(x), __builtin_cos(x))
KAAMOS_FLOAT_FUNCTION(cosh, __builtin_coshf(x), __builtin_cosh(x))
KAAMOS_FLOAT_FUNCTION(degrees, x * 57.2957795130823209f, x * 57.2957795130823209)
KAAMOS_FLOAT_FUNCTION(exp, exponential(x), __builtin_exp(x))
KAAMOS_FLOAT_FUNCTION(exp2, __builtin_exp2f(x), __builtin_exp2(x))
KAAMOS_FLOAT_FUNCTION(floor, __builtin_floorf(rounded_operand(x)), __builtin_floor(x))
KAAMOS_FLOAT_FUNCTION(log, __builtin_logf(flushed(x)), __builtin_log(x))
KAAMOS_FLOAT_FUNCTION(log10, __builtin_log10f(flushed(x)), __builtin_log10(x))
KAAMOS_FLOAT_FUNCTION(log2, __builtin_log2f(flushed(x)), __builtin_log2(x))
KAAMOS_FLOAT_FUNCTION(radians, x * 0.0174532925199432958f, x * 0.0174532925199432958)
KAAMOS_FLOAT_FUNCTION(rcp, 1.0f / x, 1.0 / x)
// Rounds halves to even: round(0.5) is 0, round(1.5) is 2.
KAAMOS_FLOAT_FUNCTION(round, __builtin_rintf(x), __builtin_rint(x))
KAAMOS_FLOAT_FUNCTION(rsqrt, 1.0f / __builtin_sqrtf(x), 1.0 / __builtin_sqrt(x))
// NaN gives 0.
KAAMOS_FLOAT_FUNCTION(saturate, x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f,
                      x > 0.0 ? (x < 1.0 ? x : 1.0) : 0.0)
KAAMOS_FLOAT_FUNCTION(sin, sine(x), __builtin_sin(x))
KAAMOS_FLOAT_FUNCTION(sinh, __builtin_sinhf(flushed(x)), __builtin_sinh(x))
KAAMOS_FLOAT_FUNCTION(sqrt, __builtin_sqrtf(x), __builtin_sqrt(x))
KAAMOS_FLOAT_FUNCTION(tan, __builtin_tanf(flushed(x)), __builtin_tan(x))
KAAMOS_FLOAT_FUNCTION(tanh, __builtin_tanhf(flushed(x)), __builtin_tanh(x))
KAAMOS_FLOAT_FUNCTION(trunc, __builtin_truncf(x), __builtin_trunc(x))
#undef KAAMOS_FLOAT_FUNCTION

namespace op {

// One implementation for float and double, with float16 computed in float.
#define KAAMOS_HALF_THROUGH_FLOAT_1         \
  KAAMOS_INLINE static half apply(half x) { \
    return to_half(apply(to_float(x)));     \
  }
#define KAAMOS_HALF_THROUGH_FLOAT_2                  \
  KAAMOS_INLINE static half apply(half x, half y) {  \
    return to_half(apply(to_float(x), to_float(y))); \
  }

// In [0, 1): for a small negative x, x - floor(x) would round to 1. Infinities give NaN.
struct Frac {
  KAAMOS_HALF_THROUGH_FLOAT_1
  KAAMOS_INLINE static float apply(float x) {
    const float f = x - __builtin_floorf(rounded_operand(x));
    return f == 1.0f ? 0x1.fffffep-1f : f;
  }
  KAAMOS_INLINE static double apply(double x) {
    const double f = x - __builtin_floor(x);
    return f == 1.0 ? 0x1.fffffffffffffp-1 : f;
  }
};

struct Abs {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T x) {
    if constexpr (is_half<T>) {
      return {static_cast<uint16_t>(x.bits & 0x7FFFu)};
    } else if constexpr (std::is_same_v<T, float>) {
      return __builtin_fabsf(x);
    } else if constexpr (std::is_same_v<T, double>) {
      return __builtin_fabs(x);
    } else if constexpr (std::is_signed_v<T>) {
      return x < 0 ? Negate::apply(x) : x;
    } else {
      return x;
    }
  }
};

// NaN and zeros give 0.
struct Sign {
  template <class T>
  KAAMOS_CONSTEXPR static int32_t apply(T x) {
    const auto c = comparable(x);
    return int32_t{c > decltype(c){}} - int32_t{c < decltype(c){}};
  }
};

// If one operand is NaN, the result is the other. [D3D11.3 min, max]
struct Min {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T x, T y) {
    if constexpr (is_float<T>) {
      const auto a = comparable(x), b = comparable(y);
      return a < b || b != b ? x : y;
    } else {
      return x < y ? x : y;
    }
  }
};
struct Max {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T x, T y) {
    if constexpr (is_float<T>) {
      const auto a = comparable(x), b = comparable(y);
      return a >= b || b != b ? x : y;
    } else {
      return x > y ? x : y;
    }
  }
};
struct Clamp {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T x, T low, T high) {
    return Min::apply(Max::apply(x, low), high);
  }
};

// Zeros as in DXC's expansion: those of x have no sign, and neither have those of y where x is
// negative, so atan2(0, 0) is pi / 2 and atan2(-0, -1) is pi. Two infinities have an angle here;
// the expansion gives NaN. [DXC: TranslateAtan2]
struct Atan2 {
  KAAMOS_HALF_THROUGH_FLOAT_2
  KAAMOS_INLINE static float apply(float y, float x) {
    const float a = flushed(y), b = flushed(x);
    return __builtin_atan2f(a == 0 && b <= 0 ? (b < 0 ? 0.0f : 1.0f) : a, b == 0 ? 0.0f : b);
  }
  KAAMOS_INLINE static double apply(double y, double x) {
    return __builtin_atan2(y == 0 && x <= 0 ? (x < 0 ? 0.0 : 1.0) : y, x == 0 ? 0.0 : x);
  }
};

// exp2(y * log2(x)) in HLSL: NaN for negative x, whatever y is, and where the product is that of 0
// and an infinity: 0 and infinity to the power 0, 1 to the power of an infinity.
struct Pow {
  KAAMOS_HALF_THROUGH_FLOAT_2
  KAAMOS_INLINE static float apply(float x, float y) {
    const float base = __builtin_fabsf(flushed(x));
    return x >= 0 && has_product(base, flushed(y)) ? __builtin_powf(base, y) : __builtin_nanf("");
  }
  KAAMOS_INLINE static double apply(double x, double y) {
    const double base = __builtin_fabs(x);
    return x >= 0 && has_product(base, y) ? __builtin_pow(base, y) : __builtin_nan("");
  }

 private:
  template <class T>
  KAAMOS_INLINE static bool has_product(T base, T y) {
    if (y == 0) return base != 0 && base - base == 0;
    return y == y && (base != 1 || y - y == 0);
  }
};

// x * 2^e. In HLSL the exponent is a float, and may have a fraction.
struct Ldexp {
  KAAMOS_HALF_THROUGH_FLOAT_2
  KAAMOS_INLINE static float apply(float x, float e) {
    if (__builtin_truncf(e) == e && __builtin_fabsf(e) < 1000) {
      return flushed(__builtin_ldexpf(flushed(x), static_cast<int>(e)));
    }
    return x * __builtin_exp2f(e);
  }
  KAAMOS_INLINE static double apply(double x, double e) {
    if (__builtin_trunc(e) == e && __builtin_fabs(e) < 10000) {
      return __builtin_ldexp(x, static_cast<int>(e));
    }
    return x * __builtin_exp2(e);
  }
};

// Of |x|, as in DXC, which takes the bits of the number apart: an infinity is 0.5 * 2^129, a NaN
// has a mantissa and the exponent 129 too. Doubles, which DXC does not take, keep those as they
// are, with the exponent 0.
struct FrexpMantissa {
  KAAMOS_HALF_THROUGH_FLOAT_1
  KAAMOS_INLINE static float apply(float x) {
    const uint32_t bits = __builtin_bit_cast(uint32_t, flushed(x));
    const uint32_t mantissa = (bits & 0x7FFFFFu) | 0x3F000000u;
    return (bits & 0x7FFFFFFFu) == 0 ? 0.0f : __builtin_bit_cast(float, mantissa);
  }
  KAAMOS_INLINE static double apply(double x) {
    int exponent;
    return __builtin_fabs(__builtin_frexp(x, &exponent));
  }
};
struct FrexpExponent {
  KAAMOS_HALF_THROUGH_FLOAT_1
  KAAMOS_INLINE static float apply(float x) {
    const uint32_t magnitude = __builtin_bit_cast(uint32_t, flushed(x)) & 0x7FFFFFFFu;
    const int32_t exponent = static_cast<int32_t>(magnitude >> 23) - 126;
    return magnitude == 0 ? 0.0f : static_cast<float>(exponent);
  }
  KAAMOS_INLINE static double apply(double x) {
    int exponent = 0;
    __builtin_frexp(x, &exponent);
    return x - x == 0.0 ? exponent : 0.0;
  }
};

struct ModfInteger {
  KAAMOS_HALF_THROUGH_FLOAT_1
  template <class T>
  KAAMOS_INLINE static T apply(T x) {
    if constexpr (is_integer<T>) {
      return x;
    } else {
      return trunc_function::apply(x);
    }
  }
};
struct ModfFraction {
  template <class T>
  KAAMOS_INLINE static T apply(T x) {
    return Subtract::apply(x, ModfInteger::apply(x));
  }
};

struct Fma {
  KAAMOS_INLINE static half apply(half x, half y, half z) {
    // The product is exact in double, and so is the sum wherever it is close to the middle between
    // two halves, so the result is rounded only once.
    return to_half(static_cast<double>(to_float(x)) * static_cast<double>(to_float(y)) +
                   static_cast<double>(to_float(z)));
  }
  KAAMOS_INLINE static float apply(float x, float y, float z) { return __builtin_fmaf(x, y, z); }
  KAAMOS_INLINE static double apply(double x, double y, double z) { return __builtin_fma(x, y, z); }
};
struct Mad {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T x, T y, T z) {
    return Add::apply(Multiply::apply(x, y), z);
  }
};
struct Lerp {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T x, T y, T s) {
    return Add::apply(x, Multiply::apply(s, Subtract::apply(y, x)));
  }
};
// x < edge ? 0 : 1, so that NaN gives 1.
struct Step {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T edge, T x) {
    return Convert<T>::apply(!(comparable(x) < comparable(edge)));
  }
};
struct Smoothstep {
  KAAMOS_INLINE static half apply(half low, half high, half x) {
    return to_half(apply(to_float(low), to_float(high), to_float(x)));
  }
  template <class T>
  KAAMOS_INLINE static T apply(T low, T high, T x) {
    const T t = saturate_function::apply((x - low) / (high - low));
    return t * t * (T{3} - T{2} * t);
  }
};
#undef KAAMOS_HALF_THROUGH_FLOAT_1
#undef KAAMOS_HALF_THROUGH_FLOAT_2

}  // namespace op

template <class V>
KAAMOS_CONSTEXPR V abs(const V& x) {
  return map<op::Abs>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, int32_t> sign(const V& x) {
  return map<op::Sign>(x);
}
template <class V>
KAAMOS_CONSTEXPR V min(const V& x, const V& y) {
  return map<op::Min>(x, y);
}
template <class V>
KAAMOS_CONSTEXPR V max(const V& x, const V& y) {
  return map<op::Max>(x, y);
}
template <class V>
KAAMOS_CONSTEXPR V clamp(const V& x, const V& low, const V& high) {
  return map<op::Clamp>(x, low, high);
}
template <class V>
KAAMOS_INLINE V frac(const V& x) {
  return map<op::Frac>(x);
}
template <class V>
KAAMOS_INLINE V fmod(const V& x, const V& y) {
  return map<op::Modulo>(x, y);
}
template <class V>
KAAMOS_INLINE V atan2(const V& y, const V& x) {
  return map<op::Atan2>(y, x);
}
template <class V>
KAAMOS_INLINE V pow(const V& x, const V& y) {
  return map<op::Pow>(x, y);
}
template <class V>
KAAMOS_INLINE V ldexp(const V& x, const V& exponent) {
  return map<op::Ldexp>(x, exponent);
}
template <class V>
KAAMOS_INLINE V frexp_mantissa(const V& x) {
  return map<op::FrexpMantissa>(x);
}
template <class V>
KAAMOS_INLINE V frexp_exponent(const V& x) {
  return map<op::FrexpExponent>(x);
}
template <class V>
KAAMOS_INLINE V modf_fraction(const V& x) {
  return map<op::ModfFraction>(x);
}
template <class V>
KAAMOS_INLINE V modf_integer(const V& x) {
  return map<op::ModfInteger>(x);
}
template <class V>
KAAMOS_INLINE V fma(const V& x, const V& y, const V& z) {
  return map<op::Fma>(x, y, z);
}
// x * y + z, rounded twice; for integers, too.
template <class V>
KAAMOS_CONSTEXPR V mad(const V& x, const V& y, const V& z) {
  return map<op::Mad>(x, y, z);
}
// x + s * (y - x)
template <class V>
KAAMOS_CONSTEXPR V lerp(const V& x, const V& y, const V& s) {
  return map<op::Lerp>(x, y, s);
}
template <class V>
KAAMOS_CONSTEXPR V step(const V& edge, const V& x) {
  return map<op::Step>(edge, x);
}
template <class V>
KAAMOS_INLINE V smoothstep(const V& low, const V& high, const V& x) {
  return map<op::Smoothstep>(low, high, x);
}

}  // namespace kaamos::shader
