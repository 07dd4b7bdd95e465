// SPDX-License-Identifier: MIT
//
// Vector geometry, mul() and matrices. Sums run from the first component to the last without fused
// multiply-add, so that every backend can give the same bits. float16 sums are kept in float and
// rounded once.
#pragma once

#include "kaamos/shader/intrinsics_scalar.h"

namespace kaamos::shader {
namespace op {

// The type in which sums of products of T are kept.
template <class T>
using Sum = std::conditional_t<is_half<T>, float, T>;

template <class T>
KAAMOS_CONSTEXPR Sum<T> widen(T x) {
  return Convert<Sum<T>>::apply(x);
}

// a[0] * b[0] + a[1] * b[1] + ...
template <class T, int N>
KAAMOS_CONSTEXPR Sum<T> dot_sum(const vec<T, N>& a, const vec<T, N>& b) {
  if constexpr (std::is_same_v<T, float> && N == 4) {
    // The same products, written as one operation, which lets gcc find that everything leading to
    // these float4s can be done on all four components at once.
    if (!std::is_constant_evaluated()) {
      using Four = float __attribute__((vector_size(16)));
      const Four left = {a.e[0], a.e[1], a.e[2], a.e[3]};
      const Four right = {b.e[0], b.e[1], b.e[2], b.e[3]};
      const Four products = left * right;
      return ((products[0] + products[1]) + products[2]) + products[3];
    }
  }
  Sum<T> sum = Multiply::apply(widen(a.e[0]), widen(b.e[0]));
  unroll<N - 1>([&](int i) KAAMOS_INLINE_LAMBDA {
    sum = Add::apply(sum, Multiply::apply(widen(a.e[i + 1]), widen(b.e[i + 1])));
  });
  return sum;
}
template <class T>
KAAMOS_CONSTEXPR Sum<T> dot_sum(T a, T b) {
  return Multiply::apply(widen(a), widen(b));
}

}  // namespace op

template <class V>
KAAMOS_CONSTEXPR scalar_of<V> dot(const V& a, const V& b) {
  return op::Convert<scalar_of<V>>::apply(op::dot_sum(a, b));
}

template <class V>
KAAMOS_INLINE scalar_of<V> length(const V& v) {
  if constexpr (shape<V>::is_scalar) {
    return abs(v);
  } else {
    return op::Convert<scalar_of<V>>::apply(sqrt(op::dot_sum(v, v)));
  }
}

template <class V>
KAAMOS_INLINE scalar_of<V> distance(const V& a, const V& b) {
  return length(sub(b, a));
}

// The zero vector gives NaN.
template <class V>
KAAMOS_INLINE V normalize(const V& v) {
  const auto scale = rsqrt(op::dot_sum(v, v));
  return mul_c(v, splat<V>(op::Convert<scalar_of<V>>::apply(scale)));
}

template <class T>
KAAMOS_CONSTEXPR vec<T, 3> cross(const vec<T, 3>& a, const vec<T, 3>& b) {
  return sub(mul_c(swizzle<1, 2, 0>(a), swizzle<2, 0, 1>(b)),
             mul_c(swizzle<2, 0, 1>(a), swizzle<1, 2, 0>(b)));
}

template <class V>
KAAMOS_INLINE V reflect(const V& incident, const V& normal) {
  const auto twice = op::Convert<scalar_of<V>>::apply(op::dot_sum(incident, normal) * 2);
  return sub(incident, mul_c(splat<V>(twice), normal));
}

// Zero on total internal reflection, and where numbers are NaN.
template <class V>
KAAMOS_INLINE V refract(const V& incident, const V& normal, scalar_of<V> eta) {
  using S = op::Sum<scalar_of<V>>;
  const S e = op::widen(eta);
  const S cosine = op::dot_sum(incident, normal);
  const S k = S{1} - e * e * (S{1} - cosine * cosine);
  if (!(k >= S{0})) return V{};
  const auto along = op::Convert<scalar_of<V>>::apply(e * cosine + sqrt(k));
  return sub(mul_c(splat<V>(eta), incident), mul_c(splat<V>(along), normal));
}

template <class V>
KAAMOS_INLINE V faceforward(const V& normal, const V& incident, const V& geometric_normal) {
  return op::dot_sum(incident, geometric_normal) < 0 ? normal : negate(normal);
}

// {1, max(n.l, 0), pow(n.h, m), 1}; the third is 0 if n.l or n.h is negative
template <class T>
KAAMOS_INLINE vec<T, 4> lit(T n_dot_l, T n_dot_h, T m) {
  const T zero = op::Convert<T>::apply(0.0f);
  const T one = op::Convert<T>::apply(1.0f);
  const bool behind = less(n_dot_l, zero) || less(n_dot_h, zero);
  return {{one, less(n_dot_l, zero) ? zero : n_dot_l, behind ? zero : pow(n_dot_h, m), one}};
}

// {1, a.y * b.y, a.z, b.w}
template <class T>
KAAMOS_CONSTEXPR vec<T, 4> dst(const vec<T, 4>& a, const vec<T, 4>& b) {
  return {{op::Convert<T>::apply(1.0f), op::Multiply::apply(a.e[1], b.e[1]), a.e[2], b.e[3]}};
}

// ---------------------------------------------------------------------------------------------
// mul(): the nine combinations of scalar, vector and matrix. A vector is a row on the left of a
// matrix and a column on its right.

template <class T>
requires(shape<T>::is_scalar) KAAMOS_CONSTEXPR T mul(T a, T b) {
  return op::Multiply::apply(a, b);
}
template <class T, int N>
KAAMOS_CONSTEXPR vec<T, N> mul(T a, const vec<T, N>& b) {
  return mul_c(splat<vec<T, N>>(a), b);
}
template <class T, int N>
KAAMOS_CONSTEXPR vec<T, N> mul(const vec<T, N>& a, T b) {
  return mul_c(a, splat<vec<T, N>>(b));
}
template <class T, int R, int C>
KAAMOS_CONSTEXPR mat<T, R, C> mul(T a, const mat<T, R, C>& b) {
  return mul_c(splat<mat<T, R, C>>(a), b);
}
template <class T, int R, int C>
KAAMOS_CONSTEXPR mat<T, R, C> mul(const mat<T, R, C>& a, T b) {
  return mul_c(a, splat<mat<T, R, C>>(b));
}
template <class T, int N>
KAAMOS_CONSTEXPR T mul(const vec<T, N>& a, const vec<T, N>& b) {
  return dot(a, b);
}
template <class T, int R, int C>
KAAMOS_CONSTEXPR vec<T, R> mul(const mat<T, R, C>& m, const vec<T, C>& v) {
  vec<T, R> result{};
  unroll<R>([&](int r) KAAMOS_INLINE_LAMBDA { result.e[r] = dot(m.e[r], v); });
  return result;
}
template <class T, int R, int C>
KAAMOS_CONSTEXPR vec<T, C> mul(const vec<T, R>& v, const mat<T, R, C>& m) {
  using Row = vec<op::Sum<T>, C>;
  Row sum = mul_c(splat<Row>(op::widen(v.e[0])), convert<op::Sum<T>>(m.e[0]));
  unroll<R - 1>([&](int r) KAAMOS_INLINE_LAMBDA {
    sum = add(sum, mul_c(splat<Row>(op::widen(v.e[r + 1])), convert<op::Sum<T>>(m.e[r + 1])));
  });
  return convert<T>(sum);
}
template <class T, int R, int K, int C>
KAAMOS_CONSTEXPR mat<T, R, C> mul(const mat<T, R, K>& a, const mat<T, K, C>& b) {
  mat<T, R, C> result{};
  unroll<R>([&](int r) KAAMOS_INLINE_LAMBDA { result.e[r] = mul(a.e[r], b); });
  return result;
}

template <class T, int R, int C>
KAAMOS_CONSTEXPR mat<T, C, R> transpose(const mat<T, R, C>& m) {
  mat<T, C, R> result{};
  unroll<R>([&](int r) KAAMOS_INLINE_LAMBDA {
    unroll<C>([&](int c) KAAMOS_INLINE_LAMBDA { result.e[c].e[r] = m.e[r].e[c]; });
  });
  return result;
}

namespace op {

template <class T>
KAAMOS_CONSTEXPR T determinant_of(const mat<T, 1, 1>& m) {
  return m.e[0].e[0];
}
template <class T>
KAAMOS_CONSTEXPR T determinant_of(const mat<T, 2, 2>& m) {
  return m.e[0].e[0] * m.e[1].e[1] - m.e[0].e[1] * m.e[1].e[0];
}
template <class T>
KAAMOS_CONSTEXPR T determinant_of(const mat<T, 3, 3>& m) {
  return dot(m.e[0], cross(m.e[1], m.e[2]));
}
// From the 2x2 minors of the upper and the lower two rows.
template <class T>
KAAMOS_CONSTEXPR T determinant_of(const mat<T, 4, 4>& m) {
  const auto minor = [&m](int row, int i, int j) KAAMOS_INLINE_LAMBDA {
    return m.e[row].e[i] * m.e[row + 1].e[j] - m.e[row].e[j] * m.e[row + 1].e[i];
  };
  return minor(0, 0, 1) * minor(2, 2, 3) - minor(0, 0, 2) * minor(2, 1, 3) +
         minor(0, 0, 3) * minor(2, 1, 2) + minor(0, 1, 2) * minor(2, 0, 3) -
         minor(0, 1, 3) * minor(2, 0, 2) + minor(0, 2, 3) * minor(2, 0, 1);
}

}  // namespace op

template <class T, int N>
KAAMOS_CONSTEXPR T determinant(const mat<T, N, N>& m) {
  return op::Convert<T>::apply(op::determinant_of(convert<op::Sum<T>>(m)));
}

}  // namespace kaamos::shader
