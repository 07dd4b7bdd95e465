// SPDX-License-Identifier: MIT
//
// Intrinsics that work on bits: reinterpretation, bit counts, float16 packing, float classes.
#pragma once

#include "kaamos/shader/operators.h"

namespace kaamos::shader {
namespace op {

template <class To>
struct Reinterpret {
  template <class From>
  KAAMOS_CONSTEXPR static To apply(From x) {
    return __builtin_bit_cast(To, x);
  }
};

template <class T>
KAAMOS_CONSTEXPR auto float_bits(T x) {
  using Bits = std::conditional_t<sizeof(T) == 8, uint64_t,
                                  std::conditional_t<sizeof(T) == 4, uint32_t, uint16_t>>;
  return __builtin_bit_cast(Bits, x);
}
// The bits of infinity without its sign; anything larger is a NaN.
template <class T>
inline constexpr uint64_t kInfinityBits = sizeof(T) == 8   ? 0x7FF0000000000000u
                                          : sizeof(T) == 4 ? 0x7F800000u
                                                           : 0x7C00u;
template <class T>
inline constexpr uint64_t kSmallestNormalBits = sizeof(T) == 8   ? 0x0010000000000000u
                                                : sizeof(T) == 4 ? 0x00800000u
                                                                 : 0x0400u;
template <class T>
KAAMOS_CONSTEXPR uint64_t magnitude_bits(T x) {
  return float_bits(x) & (~uint64_t{0} >> (65 - sizeof(T) * 8));
}
struct IsNan {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T x) {
    return magnitude_bits(x) > kInfinityBits<T>;
  }
};
struct IsInf {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T x) {
    return magnitude_bits(x) == kInfinityBits<T>;
  }
};
struct IsFinite {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T x) {
    return magnitude_bits(x) < kInfinityBits<T>;
  }
};
// Neither zero, denormal, infinite nor NaN.
struct IsNormal {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T x) {
    return magnitude_bits(x) < kInfinityBits<T> && magnitude_bits(x) >= kSmallestNormalBits<T>;
  }
};

struct CountBits {
  template <class T>
  KAAMOS_CONSTEXPR static uint32_t apply(T x) {
    return static_cast<uint32_t>(__builtin_popcountll(static_cast<std::make_unsigned_t<T>>(x)));
  }
};
// The index of the bit, counted from the lowest; 0xFFFFFFFF if there is none.
struct FirstBitLow {
  template <class T>
  KAAMOS_CONSTEXPR static uint32_t apply(T x) {
    return x != 0 ? static_cast<uint32_t>(__builtin_ctzll(static_cast<uint64_t>(x))) : ~0u;
  }
};
// For negative numbers it finds the highest 0 bit.
struct FirstBitHigh {
  template <class T>
  KAAMOS_CONSTEXPR static uint32_t apply(T x) {
    const T significant = x < T{0} ? static_cast<T>(~x) : x;
    const uint64_t bits = static_cast<std::make_unsigned_t<T>>(significant);
    return bits != 0 ? static_cast<uint32_t>(63 - __builtin_clzll(bits)) : ~0u;
  }
};
struct ReverseBits {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T x) {
    using U = std::make_unsigned_t<T>;
    uint64_t v = __builtin_bswap64(static_cast<U>(x));
    v = (v >> 4 & 0x0F0F0F0F0F0F0F0Fu) | (v & 0x0F0F0F0F0F0F0F0Fu) << 4;
    v = (v >> 2 & 0x3333333333333333u) | (v & 0x3333333333333333u) << 2;
    v = (v >> 1 & 0x5555555555555555u) | (v & 0x5555555555555555u) << 1;
    return static_cast<T>(v >> (64 - sizeof(T) * 8));
  }
};

struct F16ToF32 {
  KAAMOS_CONSTEXPR static float apply(uint32_t x) {
    return to_float(half{static_cast<uint16_t>(x)});
  }
};
struct F32ToF16 {
  KAAMOS_CONSTEXPR static uint32_t apply(float x) { return to_half(x).bits; }
};

struct AsDouble {
  KAAMOS_CONSTEXPR static double apply(uint32_t low, uint32_t high) {
    return __builtin_bit_cast(double, static_cast<uint64_t>(high) << 32 | low);
  }
};
struct LowBits {
  KAAMOS_CONSTEXPR static uint32_t apply(double x) { return static_cast<uint32_t>(float_bits(x)); }
};
struct HighBits {
  KAAMOS_CONSTEXPR static uint32_t apply(double x) {
    return static_cast<uint32_t>(float_bits(x) >> 32);
  }
};

struct AnyBit {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T x) {
    return !LogicalNot::apply(x);
  }
};

}  // namespace op

template <class V>
KAAMOS_CONSTEXPR with_scalar<V, float> asfloat(const V& x) {
  return map<op::Reinterpret<float>>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, int32_t> asint(const V& x) {
  return map<op::Reinterpret<int32_t>>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, uint32_t> asuint(const V& x) {
  return map<op::Reinterpret<uint32_t>>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, half> asfloat16(const V& x) {
  return map<op::Reinterpret<half>>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, int16_t> asint16(const V& x) {
  return map<op::Reinterpret<int16_t>>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, uint16_t> asuint16(const V& x) {
  return map<op::Reinterpret<uint16_t>>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, double> asdouble(const V& low, const V& high) {
  return map<op::AsDouble>(low, high);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, uint32_t> asuint_low(const V& x) {
  return map<op::LowBits>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, uint32_t> asuint_high(const V& x) {
  return map<op::HighBits>(x);
}

template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> isnan(const V& x) {
  return map<op::IsNan>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> isinf(const V& x) {
  return map<op::IsInf>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> isfinite(const V& x) {
  return map<op::IsFinite>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> isnormal(const V& x) {
  return map<op::IsNormal>(x);
}

template <class V>
KAAMOS_CONSTEXPR with_scalar<V, uint32_t> countbits(const V& x) {
  return map<op::CountBits>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, uint32_t> firstbitlow(const V& x) {
  return map<op::FirstBitLow>(x);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, uint32_t> firstbithigh(const V& x) {
  return map<op::FirstBitHigh>(x);
}
template <class V>
KAAMOS_CONSTEXPR V reversebits(const V& x) {
  return map<op::ReverseBits>(x);
}

// Only the low 16 bits count.
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, float> f16tof32(const V& x) {
  return map<op::F16ToF32>(x);
}
// Rounds to nearest even; the high 16 bits are 0.
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, uint32_t> f32tof16(const V& x) {
  return map<op::F32ToF16>(x);
}

template <class V>
KAAMOS_CONSTEXPR bool any(const V& x) {
  const auto set = map<op::AnyBit>(x);
  bool result = false;
  unroll<shape<V>::count>([&](int i) KAAMOS_INLINE_LAMBDA { result |= component(set, i); });
  return result;
}
template <class V>
KAAMOS_CONSTEXPR bool all(const V& x) {
  const auto set = map<op::AnyBit>(x);
  bool result = true;
  unroll<shape<V>::count>([&](int i) KAAMOS_INLINE_LAMBDA { result &= component(set, i); });
  return result;
}

// Adds the sums of absolute differences between the reference's bytes and 4 windows of the source's
// 8 bytes; reference bytes of 0 are masked out.
inline uint4 msad4(uint32_t reference, const uint2& source, const uint4& accumulator) {
  const uint64_t bytes = static_cast<uint64_t>(source.e[1]) << 32 | source.e[0];
  uint4 result = accumulator;
  for (int window = 0; window < 4; ++window) {
    for (int i = 0; i < 4; ++i) {
      const uint32_t a = reference >> 8 * i & 0xFFu;
      const uint32_t b = static_cast<uint32_t>(bytes >> 8 * (window + i)) & 0xFFu;
      if (a != 0) result.e[window] += a > b ? a - b : b - a;
    }
  }
  return result;
}

}  // namespace kaamos::shader
