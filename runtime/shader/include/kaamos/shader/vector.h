// SPDX-License-Identifier: MIT
//
// HLSL's value types: vectors, matrices of rows, arrays. They are plain aggregates without
// invariants; operations on them are free functions, with one form for scalars, vectors and
// matrices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kaamos/shader/half.h"

namespace kaamos::shader {

template <class T, int N>
struct vec {
  static_assert(N >= 1 && N <= 4);
  T e[N];
  // i must be in range: element() and element_ref() are the checked forms.
  constexpr T& operator[](int i) { return e[i]; }
  constexpr const T& operator[](int i) const { return e[i]; }
};

// R rows of C columns; m.e[i] is row i, like m[i] in HLSL.
template <class T, int R, int C>
struct mat {
  static_assert(R >= 1 && R <= 4);
  vec<T, C> e[R];
  constexpr vec<T, C>& operator[](int i) { return e[i]; }
  constexpr const vec<T, C>& operator[](int i) const { return e[i]; }
};

template <class T, uint32_t N>
struct array {
  T e[N];
  constexpr T& operator[](uint32_t i) { return e[i]; }
  constexpr const T& operator[](uint32_t i) const { return e[i]; }
};

#define KAAMOS_SHADER_NAMES(name, T) \
  using name##1 = vec<T, 1>;         \
  using name##2 = vec<T, 2>;         \
  using name##3 = vec<T, 3>;         \
  using name##4 = vec<T, 4>;         \
  using name##1x1 = mat<T, 1, 1>;    \
  using name##1x2 = mat<T, 1, 2>;    \
  using name##1x3 = mat<T, 1, 3>;    \
  using name##1x4 = mat<T, 1, 4>;    \
  using name##2x1 = mat<T, 2, 1>;    \
  using name##2x2 = mat<T, 2, 2>;    \
  using name##2x3 = mat<T, 2, 3>;    \
  using name##2x4 = mat<T, 2, 4>;    \
  using name##3x1 = mat<T, 3, 1>;    \
  using name##3x2 = mat<T, 3, 2>;    \
  using name##3x3 = mat<T, 3, 3>;    \
  using name##3x4 = mat<T, 3, 4>;    \
  using name##4x1 = mat<T, 4, 1>;    \
  using name##4x2 = mat<T, 4, 2>;    \
  using name##4x3 = mat<T, 4, 3>;    \
  using name##4x4 = mat<T, 4, 4>;
KAAMOS_SHADER_NAMES(bool, bool)
KAAMOS_SHADER_NAMES(int16_t, int16_t)
KAAMOS_SHADER_NAMES(uint16_t, uint16_t)
KAAMOS_SHADER_NAMES(int, int32_t)
KAAMOS_SHADER_NAMES(uint, uint32_t)
KAAMOS_SHADER_NAMES(int64_t, int64_t)
KAAMOS_SHADER_NAMES(uint64_t, uint64_t)
KAAMOS_SHADER_NAMES(half, half)
KAAMOS_SHADER_NAMES(float, float)
KAAMOS_SHADER_NAMES(double, double)
#undef KAAMOS_SHADER_NAMES
using uint = uint32_t;

// The scalar type of a value, and its shape. Scalars are 1x1, vectors are one row.
template <class V>
struct shape {
  using scalar = V;
  static constexpr bool is_scalar = true, is_vector = false, is_matrix = false;
  static constexpr int rows = 1, columns = 1, count = 1;
  template <class To>
  using rebind = To;
};
template <class T, int N>
struct shape<vec<T, N>> {
  using scalar = T;
  static constexpr bool is_scalar = false, is_vector = true, is_matrix = false;
  static constexpr int rows = 1, columns = N, count = N;
  template <class To>
  using rebind = vec<typename shape<T>::template rebind<To>, N>;
};
template <class T, int R, int C>
struct shape<mat<T, R, C>> {
  using scalar = T;
  static constexpr bool is_scalar = false, is_vector = false, is_matrix = true;
  static constexpr int rows = R, columns = C, count = R * C;
  template <class To>
  using rebind = mat<typename shape<T>::template rebind<To>, R, C>;
};

template <class V>
using scalar_of = typename shape<V>::scalar;
template <class V, class To>
using with_scalar = typename shape<V>::template rebind<To>;

template <class T>
inline constexpr bool is_half = std::is_same_v<T, half>;
template <class T>
inline constexpr bool is_float = std::is_floating_point_v<T> || is_half<T>;
template <class T>
inline constexpr bool is_integer = std::is_integral_v<T> && !std::is_same_v<T, bool>;

// Component i of a value, counted in row-major order. i must be in range.
template <class T>
KAAMOS_CONSTEXPR T& component(T& v, int) {
  return v;
}
template <class T, int N>
KAAMOS_CONSTEXPR T& component(vec<T, N>& v, int i) {
  return v.e[i];
}
template <class T, int N>
KAAMOS_CONSTEXPR const T& component(const vec<T, N>& v, int i) {
  return v.e[i];
}
template <class T, int R, int C>
KAAMOS_CONSTEXPR T& component(mat<T, R, C>& m, int i) {
  return m.e[i / C].e[i % C];
}
template <class T, int R, int C>
KAAMOS_CONSTEXPR const T& component(const mat<T, R, C>& m, int i) {
  return m.e[i / C].e[i % C];
}

// Calls f(0) ... f(N - 1), N up to 16. A loop would do, but at -O2 gcc unrolls small loops only
// after it has decided which aggregates stay in memory.
template <int N, class F>
KAAMOS_CONSTEXPR void unroll(const F& f) {
  if constexpr (N > 4) {
    f(0), f(1), f(2), f(3);
    unroll<N - 4>([&f](int i) KAAMOS_INLINE_LAMBDA { f(i + 4); });
  } else {
    if constexpr (N > 0) f(0);
    if constexpr (N > 1) f(1);
    if constexpr (N > 2) f(2);
    if constexpr (N > 3) f(3);
  }
}

// ---------------------------------------------------------------------------------------------
// Applies Op::apply component by component, or wide_op<Op>::apply to components that hold the
// values of several threads. [wide.h, wide_operators.h]

template <class T>
struct wide;
template <class T>
inline constexpr bool is_wide = false;
template <class T>
inline constexpr bool is_wide<wide<T>> = true;
template <class Op>
struct wide_op;

template <class Op, class... T>
KAAMOS_CONSTEXPR auto map(T... x) {
  if constexpr ((is_wide<T> && ...)) {
    return wide_op<Op>::apply(x...);
  } else {
    return Op::apply(x...);
  }
}
template <class Op, int N, class... T>
KAAMOS_CONSTEXPR auto map_vector(const vec<T, N>&... v) {
  using R = decltype(map<Op>(v.e[0]...));
  if constexpr (N == 1) {
    return vec<R, 1>{{map<Op>(v.e[0]...)}};
  } else if constexpr (N == 2) {
    return vec<R, 2>{{map<Op>(v.e[0]...), map<Op>(v.e[1]...)}};
  } else if constexpr (N == 3) {
    return vec<R, 3>{{map<Op>(v.e[0]...), map<Op>(v.e[1]...), map<Op>(v.e[2]...)}};
  } else {
    return vec<R, 4>{
        {map<Op>(v.e[0]...), map<Op>(v.e[1]...), map<Op>(v.e[2]...), map<Op>(v.e[3]...)}};
  }
}
template <class Op, int M, int N, class... T>
KAAMOS_CONSTEXPR auto map_matrix(const mat<T, M, N>&... m) {
  using R = decltype(map<Op>(m.e[0].e[0]...));
  if constexpr (M == 1) {
    return mat<R, 1, N>{{map_vector<Op, N>(m.e[0]...)}};
  } else if constexpr (M == 2) {
    return mat<R, 2, N>{{map_vector<Op, N>(m.e[0]...), map_vector<Op, N>(m.e[1]...)}};
  } else if constexpr (M == 3) {
    return mat<R, 3, N>{
        {map_vector<Op, N>(m.e[0]...), map_vector<Op, N>(m.e[1]...), map_vector<Op, N>(m.e[2]...)}};
  } else {
    return mat<R, 4, N>{{map_vector<Op, N>(m.e[0]...), map_vector<Op, N>(m.e[1]...),
                         map_vector<Op, N>(m.e[2]...), map_vector<Op, N>(m.e[3]...)}};
  }
}
template <class Op, class A, int N>
KAAMOS_CONSTEXPR auto map(const vec<A, N>& a) {
  return map_vector<Op, N>(a);
}
template <class Op, class A, class B, int N>
KAAMOS_CONSTEXPR auto map(const vec<A, N>& a, const vec<B, N>& b) {
  return map_vector<Op, N>(a, b);
}
template <class Op, class A, class B, class C, int N>
KAAMOS_CONSTEXPR auto map(const vec<A, N>& a, const vec<B, N>& b, const vec<C, N>& c) {
  return map_vector<Op, N>(a, b, c);
}
template <class Op, class A, int M, int N>
KAAMOS_CONSTEXPR auto map(const mat<A, M, N>& a) {
  return map_matrix<Op, M, N>(a);
}
template <class Op, class A, class B, int M, int N>
KAAMOS_CONSTEXPR auto map(const mat<A, M, N>& a, const mat<B, M, N>& b) {
  return map_matrix<Op, M, N>(a, b);
}
template <class Op, class A, class B, class C, int M, int N>
KAAMOS_CONSTEXPR auto map(const mat<A, M, N>& a, const mat<B, M, N>& b, const mat<C, M, N>& c) {
  return map_matrix<Op, M, N>(a, b, c);
}

}  // namespace kaamos::shader
