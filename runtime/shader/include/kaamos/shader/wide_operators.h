// SPDX-License-Identifier: MIT
//
// Component-wise operations on the values of several threads. Operations without a form for
// registers apply the scalar operation lane by lane; every form gives the scalar operation's bits.
#pragma once

#include "kaamos/shader/intrinsics_bits.h"
#include "kaamos/shader/intrinsics_scalar.h"
#include "kaamos/shader/wide.h"

namespace kaamos::shader {

template <class Op>
struct lanewise {
  template <class... T>
  KAAMOS_INLINE static auto apply(const wide<T>&... x) {
    wide<decltype(Op::apply(T{}...))> out;
    for (int lane = 0; lane < kLanes; ++lane) set(out, lane, Op::apply(get(x, lane)...));
    return out;
  }
};
template <class Op>
struct wide_op : lanewise<Op> {};

// Calls f(the lane's values...) for each lane: for intrinsics that have no other form.
template <class W, class F, class... X>
KAAMOS_INLINE W call_lanes(const F& f, const X&... x) {
  W out;
  for (int lane = 0; lane < kLanes; ++lane) set(out, lane, f(get(x, lane)...));
  return out;
}

#define KAAMOS_WIDE_BINARY(Op, Result, condition, expression)                                     \
  template <>                                                                                     \
  struct wide_op<op::Op> : lanewise<op::Op> {                                                     \
    using lanewise<op::Op>::apply;                                                                \
    template <class T>                                                                            \
    requires(condition) KAAMOS_INLINE                                                             \
        static wide<Result> apply(const wide<T>& a, const wide<T>& b) {                           \
      using R = simd::Register<T>;                                                                \
      return by_register<Result>([](R x, R y) KAAMOS_INLINE_LAMBDA { return expression; }, a, b); \
    }                                                                                             \
  };
#define KAAMOS_WIDE_UNARY(Op, Result, condition, expression)                              \
  template <>                                                                             \
  struct wide_op<op::Op> : lanewise<op::Op> {                                             \
    using lanewise<op::Op>::apply;                                                        \
    template <class T>                                                                    \
    requires(condition) KAAMOS_INLINE static wide<Result> apply(const wide<T>& a) {       \
      using R [[maybe_unused]] = simd::Register<T>;                                       \
      return by_register<Result>([](R x) KAAMOS_INLINE_LAMBDA { return expression; }, a); \
    }                                                                                     \
  };

namespace simd {

// Signed sums wrap; computed as unsigned numbers, they do so with any compiler.
template <class R>
KAAMOS_INLINE auto wrapping(R x) {
  if constexpr (std::is_same_v<R, Ints>) {
    return (Uints)x;
  } else {
    return x;
  }
}
KAAMOS_INLINE Ints magnitude(Floats x) {
  return (Ints)x & 0x7FFFFFFF;
}
KAAMOS_INLINE Floats sign_of(Floats from, Floats to) {
  return (Floats)((Ints)to | ((Ints)from & static_cast<int32_t>(0x80000000u)));
}
// From 2^23 on every float is a whole number; the addition makes a signalling NaN quiet.
KAAMOS_INLINE Floats truncate(Floats x) {
  const Ints is_small = magnitude(x) < 0x4B000000;
  const Floats small = (Floats)((Ints)x & is_small);
  const Floats whole = __builtin_convertvector(__builtin_convertvector(small, Ints), Floats);
  return is_small ? sign_of(x, whole) : x + 0.0f;
}
KAAMOS_INLINE Floats round_down(Floats x) {
  const Floats t = truncate(x);
  return t > x ? t - 1.0f : t;
}
KAAMOS_INLINE Floats round_up(Floats x) {
  const Floats t = truncate(x);
  return t < x ? t + 1.0f : t;
}
// To nearest even, because adding 2^23 rounds that way.
KAAMOS_INLINE Floats round_to_even(Floats x) {
  const Floats positive = (Floats)magnitude(x);
  const Floats whole = (positive + 8388608.0f) - 8388608.0f;
  return magnitude(x) < 0x4B000000 ? sign_of(x, whole) : x + 0.0f;
}
KAAMOS_INLINE Floats square_root(Floats x) {
#if defined(__AVX2__)
  return __builtin_ia32_sqrtps256(x);
#elif defined(__SSE2__)
  return __builtin_ia32_sqrtps(x);
#else
  for (size_t i = 0; i < sizeof(x) / sizeof(float); ++i) x[i] = __builtin_sqrtf(x[i]);
  return x;
#endif
}
KAAMOS_INLINE Floats exponential(Floats x) {
  return op::exponential(
      x, [](Floats f) KAAMOS_INLINE_LAMBDA { return (Uints)f; },
      [](Uints i) KAAMOS_INLINE_LAMBDA { return (Floats)i; },
      [](Ints c, Floats a, Floats b) KAAMOS_INLINE_LAMBDA { return c ? a : b; },
      [](Ints c) KAAMOS_INLINE_LAMBDA { return sign_bits(c) == kEverySignBit; });
}
template <op::Wave W>
KAAMOS_INLINE Floats wave(Floats x) {
  return op::wave<W>(
      x, [](Floats f) KAAMOS_INLINE_LAMBDA { return (Uints)f; },
      [](Uints i) KAAMOS_INLINE_LAMBDA { return (Floats)i; },
      [](Ints c) KAAMOS_INLINE_LAMBDA { return sign_bits(c) == kEverySignBit; },
      [](Floats large, Floats result) KAAMOS_INLINE_LAMBDA {
        for (size_t i = 0; i < sizeof(Floats) / sizeof(float); ++i) {
          if (!(__builtin_fabsf(large[i]) <= op::kLargestAngle)) {
            result[i] = op::wave_of_large<W>(large[i]);
          }
        }
        return result;
      });
}
template <class R>
KAAMOS_INLINE R smaller(R x, R y) {
  if constexpr (std::is_same_v<R, Floats>) {
    return ((x < y) | (y != y)) ? x : y;
  } else {
    return x < y ? x : y;
  }
}
template <class R>
KAAMOS_INLINE R larger(R x, R y) {
  if constexpr (std::is_same_v<R, Floats>) {
    return ((x >= y) | (y != y)) ? x : y;
  } else {
    return x > y ? x : y;
  }
}
KAAMOS_INLINE Floats saturated(Floats x) {
  return x > 0.0f ? (x < 1.0f ? x : Floats{} + 1.0f) : Floats{};
}
KAAMOS_INLINE Floats fraction(Floats x) {
  const Floats f = x - round_down(x);
  return f == 1.0f ? Floats{} + 0x1.fffffep-1f : f;
}
template <class R>
KAAMOS_INLINE R absolute(R x) {
  if constexpr (std::is_same_v<R, Floats>) {
    return (R)magnitude(x);
  } else if constexpr (std::is_same_v<R, Ints>) {
    return x < 0 ? (Ints)(0 - (Uints)x) : x;
  } else {
    return x;
  }
}

// op::Convert::from_float in each lane. Values out of range are replaced before the conversion.
KAAMOS_INLINE Ints to_ints(Floats x) {
  const Ints fits = (x >= -2147483648.0f) & (x < 2147483648.0f);
  const Ints converted = __builtin_convertvector((Floats)((Ints)x & fits), Ints);
  const Ints too_large = x >= 2147483648.0f;
  const Ints too_small = x < -2147483648.0f;
  return converted | (too_large & 0x7FFFFFFF) | (too_small & static_cast<int32_t>(0x80000000u));
}
KAAMOS_INLINE Uints to_uints(Floats x) {
  const Ints is_upper = x >= 2147483648.0f;
  const Floats lowered = is_upper ? x - 2147483648.0f : x;
  const Ints fits = (x > 0.0f) & (x < 4294967296.0f);
  const Ints low = __builtin_convertvector((Floats)((Ints)lowered & fits), Ints);
  const Ints flipped = low ^ (is_upper & fits & static_cast<int32_t>(0x80000000u));
  return (Uints)(flipped | (Ints)(x >= 4294967296.0f));
}
// Two halves that are exact in float, so that only the sum rounds.
KAAMOS_INLINE Floats from_uints(Uints x) {
  const Floats low = __builtin_convertvector((Ints)(x & 0xFFFFu), Floats);
  const Floats high = __builtin_convertvector((Ints)(x >> 16), Floats);
  return high * 65536.0f + low;
}

template <class To, class From>
KAAMOS_INLINE Register<To> converted(Register<From> x) {
  using R = Register<To>;
  if constexpr (std::is_same_v<To, bool>) {
    return x != Register<From>{};
  } else if constexpr (std::is_same_v<From, bool>) {
    if constexpr (std::is_same_v<To, float>) {
      return (R)(x & 0x3F800000);
    } else {
      return (R)(x & 1);
    }
  } else if constexpr (std::is_same_v<From, float>) {
    if constexpr (std::is_same_v<To, int32_t>) {
      return to_ints(x);
    } else {
      return to_uints(x);
    }
  } else if constexpr (std::is_same_v<To, float>) {
    if constexpr (std::is_same_v<From, int32_t>) {
      return __builtin_convertvector(x, Floats);
    } else {
      return from_uints(x);
    }
  } else {
    return (R)x;
  }
}

}  // namespace simd

// Operators -----------------------------------------------------------------------------------

KAAMOS_WIDE_BINARY(Add, T, simd::is_number<T>, (R)(simd::wrapping(x) + simd::wrapping(y)))
KAAMOS_WIDE_BINARY(Subtract, T, simd::is_number<T>, (R)(simd::wrapping(x) - simd::wrapping(y)))
KAAMOS_WIDE_BINARY(Multiply, T, simd::is_number<T>, (R)(simd::wrapping(x) * simd::wrapping(y)))
KAAMOS_WIDE_BINARY(Divide, T, (std::is_same_v<T, float>), x / y)
KAAMOS_WIDE_BINARY(BitAnd, T, simd::is_in_registers<T> && !std::is_floating_point_v<T>, x& y)
KAAMOS_WIDE_BINARY(BitOr, T, simd::is_in_registers<T> && !std::is_floating_point_v<T>, x | y)
KAAMOS_WIDE_BINARY(BitXor, T, simd::is_in_registers<T> && !std::is_floating_point_v<T>, x ^ y)
KAAMOS_WIDE_BINARY(ShiftLeft, T, simd::is_number<T> && !std::is_floating_point_v<T>,
                   (R)((simd::Uints)x << ((simd::Uints)y & 31u)))
KAAMOS_WIDE_BINARY(ShiftRight, T, simd::is_number<T> && !std::is_floating_point_v<T>, x >> (y & 31))
KAAMOS_WIDE_BINARY(Less, bool, simd::is_number<T>, x < y)
KAAMOS_WIDE_BINARY(LessEqual, bool, simd::is_number<T>, x <= y)
KAAMOS_WIDE_BINARY(Greater, bool, simd::is_number<T>, x > y)
KAAMOS_WIDE_BINARY(GreaterEqual, bool, simd::is_number<T>, x >= y)
KAAMOS_WIDE_BINARY(Equal, bool, simd::is_in_registers<T>, x == y)
KAAMOS_WIDE_BINARY(NotEqual, bool, simd::is_in_registers<T>, x != y)
KAAMOS_WIDE_UNARY(Negate, T, (simd::is_number<T> && !std::is_same_v<T, bool>),
                  (R)(-simd::wrapping(x)))
KAAMOS_WIDE_UNARY(LogicalNot, bool, simd::is_in_registers<T>, x == R{})
KAAMOS_WIDE_UNARY(AnyBit, bool, simd::is_in_registers<T>, ~(x == R{}))
KAAMOS_WIDE_UNARY(BitNot, T, simd::is_in_registers<T> && !std::is_floating_point_v<T>, ~x)

template <class To>
struct wide_op<op::Convert<To>> : lanewise<op::Convert<To>> {
  using lanewise<op::Convert<To>>::apply;
  template <class From>
  KAAMOS_INLINE static auto apply(const wide<From>& x) {
    if constexpr (std::is_same_v<To, From> || is_wide<To>) {
      return x;
    } else if constexpr (simd::is_in_registers<To> && simd::is_in_registers<From>) {
      return by_register<To>([](simd::Register<From> r)
                                 KAAMOS_INLINE_LAMBDA { return simd::converted<To, From>(r); },
                             x);
    } else {
      return lanewise<op::Convert<To>>::template apply<From>(x);
    }
  }
};
template <class To>
struct wide_op<op::Reinterpret<To>> : lanewise<op::Reinterpret<To>> {
  using lanewise<op::Reinterpret<To>>::apply;
  template <class T>
  requires(simd::is_number<T>&& simd::is_number<To>) KAAMOS_INLINE
      static wide<To> apply(const wide<T>& x) {
    return by_register<To>([](auto r) KAAMOS_INLINE_LAMBDA { return (simd::Register<To>)r; }, x);
  }
};

// Intrinsics ----------------------------------------------------------------------------------

KAAMOS_WIDE_UNARY(IsNan, bool, (std::is_same_v<T, float>), simd::magnitude(x) > 0x7F800000)
KAAMOS_WIDE_UNARY(IsInf, bool, (std::is_same_v<T, float>), simd::magnitude(x) == 0x7F800000)
KAAMOS_WIDE_UNARY(IsFinite, bool, (std::is_same_v<T, float>), simd::magnitude(x) < 0x7F800000)
KAAMOS_WIDE_UNARY(IsNormal, bool, (std::is_same_v<T, float>),
                  (simd::magnitude(x) >= 0x00800000) & (simd::magnitude(x) < 0x7F800000))
KAAMOS_WIDE_UNARY(Abs, T, simd::is_number<T>, simd::absolute(x))
KAAMOS_WIDE_UNARY(Sign, int32_t, simd::is_number<T>, (x < R{}) - (x > R{}))
KAAMOS_WIDE_BINARY(Min, T, simd::is_number<T>, simd::smaller(x, y))
KAAMOS_WIDE_BINARY(Max, T, simd::is_number<T>, simd::larger(x, y))
KAAMOS_WIDE_BINARY(Step, T, (std::is_same_v<T, float>), (R)(~(y < x) & 0x3F800000))
KAAMOS_WIDE_UNARY(ceil_function, T, (std::is_same_v<T, float>), simd::round_up(x))
KAAMOS_WIDE_UNARY(cos_function, T, (std::is_same_v<T, float>), simd::wave<op::Wave::kCosine>(x))
KAAMOS_WIDE_UNARY(degrees_function, T, (std::is_same_v<T, float>), x * 57.2957795130823209f)
KAAMOS_WIDE_UNARY(exp_function, T, (std::is_same_v<T, float>), simd::exponential(x))
KAAMOS_WIDE_UNARY(floor_function, T, (std::is_same_v<T, float>), simd::round_down(x))
KAAMOS_WIDE_UNARY(radians_function, T, (std::is_same_v<T, float>), x * 0.0174532925199432958f)
KAAMOS_WIDE_UNARY(rcp_function, T, (std::is_same_v<T, float>), 1.0f / x)
KAAMOS_WIDE_UNARY(round_function, T, (std::is_same_v<T, float>), simd::round_to_even(x))
KAAMOS_WIDE_UNARY(rsqrt_function, T, (std::is_same_v<T, float>), 1.0f / simd::square_root(x))
KAAMOS_WIDE_UNARY(saturate_function, T, (std::is_same_v<T, float>), simd::saturated(x))
KAAMOS_WIDE_UNARY(sin_function, T, (std::is_same_v<T, float>), simd::wave<op::Wave::kSine>(x))
KAAMOS_WIDE_UNARY(sqrt_function, T, (std::is_same_v<T, float>), simd::square_root(x))
KAAMOS_WIDE_UNARY(trunc_function, T, (std::is_same_v<T, float>), simd::truncate(x))
KAAMOS_WIDE_UNARY(Frac, T, (std::is_same_v<T, float>), simd::fraction(x))
#undef KAAMOS_WIDE_BINARY
#undef KAAMOS_WIDE_UNARY

#define KAAMOS_WIDE_TERNARY(Op, condition, expression)                                           \
  template <>                                                                                    \
  struct wide_op<op::Op> : lanewise<op::Op> {                                                    \
    using lanewise<op::Op>::apply;                                                               \
    template <class T>                                                                           \
    requires(condition) KAAMOS_INLINE                                                            \
        static wide<T> apply(const wide<T>& a, const wide<T>& b, const wide<T>& c) {             \
      using R = simd::Register<T>;                                                               \
      return by_register<T>([](R x, R y, R z) KAAMOS_INLINE_LAMBDA { return expression; }, a, b, \
                            c);                                                                  \
    }                                                                                            \
  };
KAAMOS_WIDE_TERNARY(Clamp, simd::is_number<T>, simd::smaller(simd::larger(x, y), z))
KAAMOS_WIDE_TERNARY(Mad, simd::is_number<T>,
                    (R)(simd::wrapping(x) * simd::wrapping(y) + simd::wrapping(z)))
KAAMOS_WIDE_TERNARY(Lerp, (std::is_same_v<T, float>), x + z * (y - x))
#undef KAAMOS_WIDE_TERNARY

// The operators that geometry (dot, mul, ...) is computed with.
template <class T>
requires(simd::is_number<T>) KAAMOS_INLINE wide<T>
operator+(const wide<T>& a, const wide<T>& b) {
  return map<op::Add>(a, b);
}
template <class T>
requires(simd::is_number<T>) KAAMOS_INLINE wide<T>
operator*(const wide<T>& a, const wide<T>& b) {
  return map<op::Multiply>(a, b);
}

namespace simd {

// Returns whether any, or every, component is nonzero.
template <class V>
KAAMOS_INLINE lanes any_component(const V& x) {
  lanes set = map<op::AnyBit>(component(x, 0));
  unroll<shape<V>::count - 1>(
      [&](int i) KAAMOS_INLINE_LAMBDA { set = set | map<op::AnyBit>(component(x, i + 1)); });
  return set;
}
template <class V>
KAAMOS_INLINE lanes all_components(const V& x) {
  lanes set = map<op::AnyBit>(component(x, 0));
  unroll<shape<V>::count - 1>(
      [&](int i) KAAMOS_INLINE_LAMBDA { set = set & map<op::AnyBit>(component(x, i + 1)); });
  return set;
}

}  // namespace simd

template <class V>
requires(is_wide<scalar_of<V>>) KAAMOS_INLINE lanes any(const V& x) {
  return simd::any_component(x);
}
template <class V>
requires(is_wide<scalar_of<V>>) KAAMOS_INLINE lanes all(const V& x) {
  return simd::all_components(x);
}

}  // namespace kaamos::shader
