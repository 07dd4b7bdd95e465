// SPDX-License-Identifier: MIT
//
// Conversions between types and shapes; construction; swizzles.
#pragma once

#include "kaamos/shader/vector.h"

namespace kaamos::shader {
namespace op {

// 2^bits as a floating-point number: the first value past the range of an integer type.
template <class F>
KAAMOS_CONSTEXPR F power_of_two(int bits) {
  return static_cast<F>(uint64_t{1} << (bits - 1)) * F{2};
}

template <class To>
struct Convert {
  // Truncates; NaN gives 0, and values out of range are clamped. [D3D11.3 ftoi, ftou]
  template <class F>
  KAAMOS_CONSTEXPR static To from_float(F x) {
    constexpr int kBits = static_cast<int>(sizeof(To) * 8) - (std::is_signed_v<To> ? 1 : 0);
    constexpr To kMax = static_cast<To>(~uint64_t{0} >> (64 - kBits));
    constexpr To kMin = std::is_signed_v<To> ? static_cast<To>(-kMax - 1) : To{0};
    if (x >= power_of_two<F>(kBits)) return kMax;
    if constexpr (std::is_signed_v<To>) {
      if (x < -power_of_two<F>(kBits)) return kMin;
      return x == x ? static_cast<To>(x) : To{0};
    } else {
      return x > F{0} ? static_cast<To>(x) : To{0};
    }
  }

  template <class From>
  KAAMOS_CONSTEXPR static To apply(From x) {
    if constexpr (std::is_same_v<To, From>) {
      return x;
    } else if constexpr (is_half<From>) {
      return apply(to_float(x));
    } else if constexpr (std::is_same_v<To, bool>) {
      return x != From{};
    } else if constexpr (std::is_same_v<To, half>) {
      if constexpr (std::is_same_v<From, double>) {
        return to_half(x);
      } else {
        return to_half(static_cast<float>(x));  // integers in the range of half are exact in float
      }
    } else if constexpr (is_integer<To> && is_float<From>) {
      return from_float(x);
    } else {
      return static_cast<To>(x);
    }
  }
};

}  // namespace op

// Converts to scalar type To and keeps the shape. Integers wrap, floats round to nearest even.
template <class To, class V>
KAAMOS_CONSTEXPR with_scalar<V, To> convert(const V& v) {
  return map<op::Convert<To>>(v);
}

// A value of type V whose components are all s.
template <class V>
KAAMOS_CONSTEXPR V splat(scalar_of<V> s) {
  if constexpr (shape<V>::is_scalar) {
    return s;
  } else {
    V result{};
    unroll<shape<V>::count>([&](int i) KAAMOS_INLINE_LAMBDA { component(result, i) = s; });
    return result;
  }
}

// The leading components of a vector, or the upper left of a matrix. A matrix becomes a vector row
// by row.
template <class V, class From>
KAAMOS_CONSTEXPR V truncate(const From& from) {
  static_assert(shape<V>::count <= shape<From>::count);
  if constexpr (std::is_same_v<V, From>) {
    return from;
  } else if constexpr (shape<V>::is_matrix && shape<From>::is_matrix) {
    V result{};
    unroll<shape<V>::rows>([&](int r) KAAMOS_INLINE_LAMBDA {
      unroll<shape<V>::columns>([&](int c)
                                    KAAMOS_INLINE_LAMBDA { result.e[r].e[c] = from.e[r].e[c]; });
    });
    return result;
  } else {
    V result{};
    unroll<shape<V>::count>(
        [&](int i) KAAMOS_INLINE_LAMBDA { component(result, i) = component(from, i); });
    return result;
  }
}

// ---------------------------------------------------------------------------------------------
// Construction

template <class V>
struct is_array : std::false_type {};
template <class T, uint32_t N>
struct is_array<array<T, N>> : std::true_type {};

template <int At, class V, class Part, class... Rest>
KAAMOS_CONSTEXPR void fill(V& result, const Part& part, const Rest&... rest) {
  constexpr int kCount = shape<Part>::count;
  unroll<kCount>([&](int i) KAAMOS_INLINE_LAMBDA {
    component(result, At + i) = op::Convert<scalar_of<V>>::apply(component(part, i));
  });
  if constexpr (sizeof...(Rest) > 0) fill<At + kCount>(result, rest...);
}

// Vectors and matrices: fills in row-major order from scalars, vectors and matrices that together
// have the same number of components. Arrays: one part per element.
template <class V, class... Parts>
KAAMOS_CONSTEXPR V make(const Parts&... parts) {
  if constexpr (is_array<V>::value) {
    return V{{parts...}};
  } else {
    static_assert((shape<Parts>::count + ...) == shape<V>::count);
    if constexpr (shape<V>::is_vector && (std::is_same_v<Parts, scalar_of<V>> && ...)) {
      return V{{parts...}};
    } else {
      V result{};
      fill<0>(result, parts...);
      return result;
    }
  }
}

// ---------------------------------------------------------------------------------------------
// Swizzles. One index gives a scalar; a scalar counts as a vector with one component.

template <int... I, class V>
KAAMOS_CONSTEXPR auto swizzle(const V& v) {
  using T = scalar_of<V>;
  static_assert(((I < shape<V>::count) && ...));
  if constexpr (sizeof...(I) == 1) {
    return T{component(v, I)...};
  } else {
    return vec<T, sizeof...(I)>{{component(v, I)...}};
  }
}

// place.ij = value; no index may repeat.
template <int... I, class V, class From>
KAAMOS_CONSTEXPR void assign_swizzle(V& place, const From& value) {
  static_assert(sizeof...(I) == shape<From>::count && ((I < shape<V>::count) && ...));
  const From copy = value;  // v.xy = v.yx
  int i = 0;
  ((component(place, I) = component(copy, i++)), ...);
}

// Indices are row * 4 + column: _m12 is 6.
template <int... I, class T, int R, int C>
KAAMOS_CONSTEXPR auto matrix_swizzle(const mat<T, R, C>& m) {
  static_assert(((I / 4 < R && I % 4 < C) && ...));
  if constexpr (sizeof...(I) == 1) {
    return T{m.e[I / 4].e[I % 4]...};
  } else {
    return vec<T, sizeof...(I)>{{m.e[I / 4].e[I % 4]...}};
  }
}

template <int... I, class T, int R, int C, class From>
KAAMOS_CONSTEXPR void assign_matrix_swizzle(mat<T, R, C>& place, const From& value) {
  static_assert(sizeof...(I) == shape<From>::count && ((I / 4 < R && I % 4 < C) && ...));
  const From copy = value;
  int i = 0;
  ((place.e[I / 4].e[I % 4] = component(copy, i++)), ...);
}

// ---------------------------------------------------------------------------------------------
// Subscripts: vector components, matrix rows, array elements. The index is any int32 or uint32
// value: reads out of range give zeros, writes are dropped.

template <class V>
struct subscript;
template <class T, int N>
struct subscript<vec<T, N>> {
  using type = T;
  static constexpr uint32_t count = N;
};
template <class T, int R, int C>
struct subscript<mat<T, R, C>> {
  using type = vec<T, C>;
  static constexpr uint32_t count = R;
};
template <class T, uint32_t N>
struct subscript<array<T, N>> {
  using type = T;
  static constexpr uint32_t count = N;
};
template <class V>
using subscript_of = typename subscript<V>::type;

template <class V, class I>
KAAMOS_CONSTEXPR subscript_of<V> element(const V& v, I index) {
  const uint32_t i = static_cast<uint32_t>(index);
  return i < subscript<V>::count ? v.e[i] : subscript_of<V>{};
}

// An index out of range refers to the scratch object, which lives only to the end of the full
// expression, so use the reference immediately.
template <class V, class I>
KAAMOS_CONSTEXPR subscript_of<V>& element_ref(V& place, I index,
                                              subscript_of<V>&& scratch = subscript_of<V>{}) {
  const uint32_t i = static_cast<uint32_t>(index);
  return i < subscript<V>::count ? place.e[i] : scratch;
}

template <class V, class I>
KAAMOS_CONSTEXPR void assign_element(V& place, I index, const subscript_of<V>& value) {
  const uint32_t i = static_cast<uint32_t>(index);
  if (i < subscript<V>::count) place.e[i] = value;
}

}  // namespace kaamos::shader
