// SPDX-License-Identifier: MIT
//
// HLSL's operators as functions for scalars, vectors and matrices, component by component on
// operands of equal type. Nothing here is undefined behaviour, and nothing traps.
#pragma once

#include "kaamos/shader/vector.h"

namespace kaamos::shader {
namespace op {

// Unsigned and at least as wide as int, so that products of uint16_t cannot overflow an int.
template <class T>
using Wrapping = std::conditional_t<sizeof(T) == 8, uint64_t, uint32_t>;

struct Add {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a, T b) {
    if constexpr (is_half<T>) {
      return to_half(to_float(a) + to_float(b));
    } else if constexpr (is_integer<T>) {
      return static_cast<T>(static_cast<Wrapping<T>>(a) + static_cast<Wrapping<T>>(b));
    } else {
      return a + b;
    }
  }
};
struct Subtract {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a, T b) {
    if constexpr (is_half<T>) {
      return to_half(to_float(a) - to_float(b));
    } else if constexpr (is_integer<T>) {
      return static_cast<T>(static_cast<Wrapping<T>>(a) - static_cast<Wrapping<T>>(b));
    } else {
      return a - b;
    }
  }
};
struct Multiply {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a, T b) {
    if constexpr (is_half<T>) {
      return to_half(to_float(a) * to_float(b));
    } else if constexpr (is_integer<T>) {
      return static_cast<T>(static_cast<Wrapping<T>>(a) * static_cast<Wrapping<T>>(b));
    } else {
      return a * b;
    }
  }
};
// Integers: x / 0 has all bits set; the lowest value divided by -1 gives itself.
struct Divide {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a, T b) {
    if constexpr (is_half<T>) {
      return to_half(to_float(a) / to_float(b));
    } else if constexpr (is_integer<T>) {
      if (b == 0) return static_cast<T>(-1);
      if constexpr (std::is_signed_v<T>) {
        if (b == -1) return Subtract::apply(T{0}, a);
      }
      return static_cast<T>(a / b);
    } else {
      return a / b;
    }
  }
};
// Has the sign of the dividend. Integers: x % 0 has all bits set.
// Denormal floats count as zero of the same sign, as arguments and as results [D3D11.3: fp32].
// Arithmetic does so in hardware; this is for functions that work on bits.
KAAMOS_INLINE float flushed(float x) {
  const uint32_t bits = __builtin_bit_cast(uint32_t, x);
  return (bits & 0x7F800000u) != 0 ? x : __builtin_bit_cast(float, bits & 0x80000000u);
}

struct Modulo {
  template <class T>
  KAAMOS_INLINE static T apply(T a, T b) {
    if constexpr (is_half<T>) {
      return to_half(__builtin_fmodf(to_float(a), to_float(b)));
    } else if constexpr (is_integer<T>) {
      if (b == 0) return static_cast<T>(-1);
      if constexpr (std::is_signed_v<T>) {
        if (b == -1) return T{0};
      }
      return static_cast<T>(a % b);
    } else if constexpr (sizeof(T) == 4) {
      return flushed(__builtin_fmodf(flushed(a), flushed(b)));
    } else {
      return __builtin_fmod(a, b);
    }
  }
};
struct BitAnd {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a, T b) {
    return static_cast<T>(a & b);
  }
};
struct BitOr {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a, T b) {
    return static_cast<T>(a | b);
  }
};
struct BitXor {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a, T b) {
    return static_cast<T>(a ^ b);
  }
};
struct ShiftLeft {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a, T b) {
    return static_cast<T>(static_cast<Wrapping<T>>(a) << (b & T{sizeof(T) * 8 - 1}));
  }
};
struct ShiftRight {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a, T b) {
    return static_cast<T>(a >> (b & T{sizeof(T) * 8 - 1}));
  }
};

template <class T>
KAAMOS_CONSTEXPR auto comparable(T a) {
  if constexpr (is_half<T>) {
    return to_float(a);
  } else {
    return a;
  }
}
struct Less {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T a, T b) {
    return comparable(a) < comparable(b);
  }
};
struct LessEqual {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T a, T b) {
    return comparable(a) <= comparable(b);
  }
};
struct Greater {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T a, T b) {
    return comparable(a) > comparable(b);
  }
};
struct GreaterEqual {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T a, T b) {
    return comparable(a) >= comparable(b);
  }
};
struct Equal {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T a, T b) {
    return comparable(a) == comparable(b);
  }
};
struct NotEqual {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T a, T b) {
    return comparable(a) != comparable(b);
  }
};
struct Negate {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a) {
    if constexpr (is_half<T>) {
      return {static_cast<uint16_t>(a.bits ^ 0x8000u)};
    } else if constexpr (is_integer<T>) {
      return Subtract::apply(T{0}, a);
    } else {
      return static_cast<T>(-a);
    }
  }
};
struct LogicalNot {
  template <class T>
  KAAMOS_CONSTEXPR static bool apply(T a) {
    return comparable(a) == decltype(comparable(a)){};
  }
};
struct BitNot {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(T a) {
    if constexpr (std::is_same_v<T, bool>) {
      return !a;
    } else {
      return static_cast<T>(~a);
    }
  }
};
struct Select {
  template <class T>
  KAAMOS_CONSTEXPR static T apply(bool condition, T a, T b) {
    return condition ? a : b;
  }
};

}  // namespace op

template <class V>
KAAMOS_CONSTEXPR V add(const V& a, const V& b) {
  return map<op::Add>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR V sub(const V& a, const V& b) {
  return map<op::Subtract>(a, b);
}
// HLSL's component-wise `a * b`. Linear algebra is in mul().
template <class V>
KAAMOS_CONSTEXPR V mul_c(const V& a, const V& b) {
  return map<op::Multiply>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR V div(const V& a, const V& b) {
  return map<op::Divide>(a, b);
}
template <class V>
KAAMOS_INLINE V mod(const V& a, const V& b) {
  return map<op::Modulo>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR V bit_and(const V& a, const V& b) {
  return map<op::BitAnd>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR V bit_or(const V& a, const V& b) {
  return map<op::BitOr>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR V bit_xor(const V& a, const V& b) {
  return map<op::BitXor>(a, b);
}
// Only the low 5 bits of the count matter (4 for 16-bit and 6 for 64-bit integers).
template <class V>
KAAMOS_CONSTEXPR V shl(const V& a, const V& b) {
  return map<op::ShiftLeft>(a, b);
}
// An arithmetic shift for signed integers.
template <class V>
KAAMOS_CONSTEXPR V shr(const V& a, const V& b) {
  return map<op::ShiftRight>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> less(const V& a, const V& b) {
  return map<op::Less>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> less_equal(const V& a, const V& b) {
  return map<op::LessEqual>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> greater(const V& a, const V& b) {
  return map<op::Greater>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> greater_equal(const V& a, const V& b) {
  return map<op::GreaterEqual>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> equal(const V& a, const V& b) {
  return map<op::Equal>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> not_equal(const V& a, const V& b) {
  return map<op::NotEqual>(a, b);
}
template <class V>
KAAMOS_CONSTEXPR V negate(const V& a) {
  return map<op::Negate>(a);
}
template <class V>
KAAMOS_CONSTEXPR with_scalar<V, bool> logical_not(const V& a) {
  return map<op::LogicalNot>(a);
}
template <class V>
KAAMOS_CONSTEXPR V bit_not(const V& a) {
  return map<op::BitNot>(a);
}

// A scalar condition chooses a whole value of any type, including structures and arrays.
template <class V>
KAAMOS_CONSTEXPR V select(bool condition, const V& a, const V& b) {
  return condition ? a : b;
}
// Component by component, because choosing between two places and copying from there would wait for
// both.
template <class T, int N>
KAAMOS_CONSTEXPR vec<T, N> select(bool condition, const vec<T, N>& a, const vec<T, N>& b) {
  vec<T, N> result{};
  unroll<N>([&](int i) KAAMOS_INLINE_LAMBDA { result.e[i] = condition ? a.e[i] : b.e[i]; });
  return result;
}
template <class T, int N>
KAAMOS_CONSTEXPR vec<T, N> select(const vec<bool, N>& condition, const vec<T, N>& a,
                                  const vec<T, N>& b) {
  return map<op::Select>(condition, a, b);
}
template <class T, int R, int C>
KAAMOS_CONSTEXPR mat<T, R, C> select(const mat<bool, R, C>& condition, const mat<T, R, C>& a,
                                     const mat<T, R, C>& b) {
  return map<op::Select>(condition, a, b);
}

}  // namespace kaamos::shader
