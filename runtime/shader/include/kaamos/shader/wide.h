// SPDX-License-Identifier: MIT
//
// The values of several threads of a shader side by side: wide<T> holds a T for each of kLanes
// threads, vec<wide<T>, N> a vector for each, and so on for matrices, arrays and structs. What the
// prelude does to components (map()) it does to these lane by lane, with exactly the results of the
// scalar code; wide_operators.h has the operations that work on whole registers.
//
// Compiler vectors are as long as a register of the instruction set that the unit is compiled for;
// compilers split longer ones badly.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/convert.h"
#include "kaamos/shader/intrinsics_geometry.h"
#include "kaamos/shader/vector.h"

namespace kaamos::shader {

namespace simd {

#ifdef __AVX2__
inline constexpr int kRegisterBytes = 32;
#else
inline constexpr int kRegisterBytes = 16;
#endif
using Floats [[gnu::vector_size(kRegisterBytes)]] = float;
using Ints [[gnu::vector_size(kRegisterBytes)]] = int32_t;
using Uints [[gnu::vector_size(kRegisterBytes)]] = uint32_t;

template <class T>
struct register_of {
  using type = void;
};
template <>
struct register_of<float> {
  using type = Floats;
};
template <>
struct register_of<int32_t> {
  using type = Ints;
};
template <>
struct register_of<uint32_t> {
  using type = Uints;
};
// All bits of a lane have the same value.
template <>
struct register_of<bool> {
  using type = Ints;
};
template <class T>
using Register = typename register_of<T>::type;
template <class T>
inline constexpr bool is_number =
    std::is_same_v<T, float> || std::is_same_v<T, int32_t> || std::is_same_v<T, uint32_t>;
template <class T>
inline constexpr bool is_in_registers = is_number<T> || std::is_same_v<T, bool>;

}  // namespace simd

template <class T>
struct wide {
  T e[kLanes];
};
template <class T>
requires(simd::is_in_registers<T>) struct wide<T> {
  simd::Register<T> a;
#ifndef __AVX2__
  simd::Register<T> b;
#endif
};

// One bit per thread: which threads are active.
using lanes = wide<bool>;

template <class T>
struct shape<wide<T>> {
  using scalar = wide<T>;
  static constexpr bool is_scalar = true, is_vector = false, is_matrix = false;
  static constexpr int rows = 1, columns = 1, count = 1;
  template <class To>
  using rebind = std::conditional_t<is_wide<To>, To, wide<To>>;
};

// Applies f to the registers, one after another.
template <class To, class F, class... T>
KAAMOS_INLINE wide<To> by_register(const F& f, const wide<T>&... x) {
#ifdef __AVX2__
  return {f(x.a...)};
#else
  return {f(x.a...), f(x.b...)};
#endif
}

// ---------------------------------------------------------------------------------------------
// One lane. Structs in emitted code have members get and set.

template <class T>
KAAMOS_INLINE T get(const wide<T>& x, int lane) {
  using Stored = std::conditional_t<std::is_same_v<T, bool>, int32_t, T>;
  Stored stored;
  __builtin_memcpy(
      &stored, reinterpret_cast<const uint8_t*>(&x) + static_cast<size_t>(lane) * sizeof(Stored),
      sizeof(Stored));
  if constexpr (std::is_same_v<T, bool>) {
    return stored != 0;
  } else {
    return stored;
  }
}
template <class T>
KAAMOS_INLINE void set(wide<T>& x, int lane, T value) {
  using Stored = std::conditional_t<std::is_same_v<T, bool>, int32_t, T>;
  Stored stored;
  if constexpr (std::is_same_v<T, bool>) {
    stored = value ? -1 : 0;
  } else {
    stored = value;
  }
  __builtin_memcpy(reinterpret_cast<uint8_t*>(&x) + static_cast<size_t>(lane) * sizeof(Stored),
                   &stored, sizeof(Stored));
}
template <class W>
requires requires(const W& x) {
  x.get(0);
}
KAAMOS_INLINE auto get(const W& x, int lane) {
  return x.get(lane);
}
template <class W, class V>
requires requires(W& x, const V& value) {
  x.set(0, value);
}
KAAMOS_INLINE void set(W& x, int lane, const V& value) {
  x.set(lane, value);
}

// The type of one lane of a W.
template <class W>
struct lane_of {
  using type = typename W::lane;
};
template <class T>
struct lane_of<wide<T>> {
  using type = T;
};
template <class T, int N>
struct lane_of<vec<T, N>> {
  using type = vec<typename lane_of<T>::type, N>;
};
template <class T, int R, int C>
struct lane_of<mat<T, R, C>> {
  using type = mat<typename lane_of<T>::type, R, C>;
};
template <class T, uint32_t N>
struct lane_of<array<T, N>> {
  using type = array<typename lane_of<T>::type, N>;
};
template <class W>
using Lane = typename lane_of<W>::type;

template <class T, int N>
KAAMOS_INLINE auto get(const vec<T, N>& x, int lane) {
  Lane<vec<T, N>> out{};
  unroll<N>([&](int i) KAAMOS_INLINE_LAMBDA { out.e[i] = get(x.e[i], lane); });
  return out;
}
template <class T, int N>
KAAMOS_INLINE void set(vec<T, N>& x, int lane, const Lane<vec<T, N>>& value) {
  unroll<N>([&](int i) KAAMOS_INLINE_LAMBDA { set(x.e[i], lane, value.e[i]); });
}
template <class T, int R, int C>
KAAMOS_INLINE auto get(const mat<T, R, C>& x, int lane) {
  Lane<mat<T, R, C>> out{};
  unroll<R>([&](int i) KAAMOS_INLINE_LAMBDA { out.e[i] = get(x.e[i], lane); });
  return out;
}
template <class T, int R, int C>
KAAMOS_INLINE void set(mat<T, R, C>& x, int lane, const Lane<mat<T, R, C>>& value) {
  unroll<R>([&](int i) KAAMOS_INLINE_LAMBDA { set(x.e[i], lane, value.e[i]); });
}
template <class T, uint32_t N>
KAAMOS_INLINE auto get(const array<T, N>& x, int lane) {
  Lane<array<T, N>> out{};
  for (uint32_t i = 0; i < N; ++i) out.e[i] = get(x.e[i], lane);
  return out;
}
template <class T, uint32_t N>
KAAMOS_INLINE void set(array<T, N>& x, int lane, const Lane<array<T, N>>& value) {
  for (uint32_t i = 0; i < N; ++i) set(x.e[i], lane, value.e[i]);
}

// Applies change to what one lane contains.
template <class W, class F>
KAAMOS_INLINE void change_lane(W&& x, int lane, const F& change) {
  auto whole = get(x, lane);
  change(whole);
  set(x, lane, whole);
}

// ---------------------------------------------------------------------------------------------
// One value in all lanes.

template <class T>
KAAMOS_INLINE void fill_lanes(wide<T>& out, T value) {
  if constexpr (simd::is_in_registers<T>) {
    // As an integer, because 0 + -0 is 0.
    int32_t bits;
    if constexpr (std::is_same_v<T, bool>) {
      bits = value ? -1 : 0;
    } else {
      bits = __builtin_bit_cast(int32_t, value);
    }
    using R = simd::Register<T>;
    out = by_register<T>([bits](R) KAAMOS_INLINE_LAMBDA { return (R)(simd::Ints{} + bits); },
                         wide<T>{});
  } else {
    for (T& lane : out.e) lane = value;
  }
}
template <class W>
requires requires(W& x, const typename W::lane& value) {
  x.fill(value);
}
KAAMOS_INLINE void fill_lanes(W& out, const typename W::lane& value) {
  out.fill(value);
}
template <class T, int N>
KAAMOS_INLINE void fill_lanes(vec<T, N>& out, const Lane<vec<T, N>>& value) {
  unroll<N>([&](int i) KAAMOS_INLINE_LAMBDA { fill_lanes(out.e[i], value.e[i]); });
}
template <class T, int R, int C>
KAAMOS_INLINE void fill_lanes(mat<T, R, C>& out, const Lane<mat<T, R, C>>& value) {
  unroll<R>([&](int i) KAAMOS_INLINE_LAMBDA { fill_lanes(out.e[i], value.e[i]); });
}
template <class T, uint32_t N>
KAAMOS_INLINE void fill_lanes(array<T, N>& out, const Lane<array<T, N>>& value) {
  for (uint32_t i = 0; i < N; ++i) fill_lanes(out.e[i], value.e[i]);
}
// True if W consists of nothing but 32-bit words, in the order of a lane's memory.
template <class W>
constexpr bool is_words = false;
template <class T>
constexpr bool is_words<wide<T>> = simd::is_number<T> && sizeof(T) == 4;
template <class T, int N>
constexpr bool is_words<vec<T, N>> = is_words<T>;
template <class T, int R, int C>
constexpr bool is_words<mat<T, R, C>> = is_words<T>;
template <class T, uint32_t N>
constexpr bool is_words<array<T, N>> = is_words<T>;
template <class W>
requires requires {
  W::words;
}
constexpr bool is_words<W> = W::words;

template <class W>
KAAMOS_INLINE W spread(const Lane<W>& value) {
  W out;
  fill_lanes(out, value);
  return out;
}

// ---------------------------------------------------------------------------------------------
// Active lanes.

namespace simd {

// One bit for each lane of a register, set if the lane is negative.
KAAMOS_INLINE uint32_t sign_bits(Ints x) {
#if defined(__AVX2__)
  return static_cast<uint32_t>(__builtin_ia32_movmskps256((Floats)x));
#elif defined(__SSE2__)
  return static_cast<uint32_t>(__builtin_ia32_movmskps((Floats)x));
#else
  uint32_t bits = 0;
  for (int i = 0; i < kRegisterBytes / 4; ++i) bits |= static_cast<uint32_t>(x[i] < 0) << i;
  return bits;
#endif
}
inline constexpr uint32_t kEverySignBit = (1u << kRegisterBytes / 4) - 1;

}  // namespace simd

// Bit i stands for lane i.
KAAMOS_INLINE uint32_t bits_of(const lanes& x) {
#ifdef __AVX2__
  return simd::sign_bits(x.a);
#else
  return simd::sign_bits(x.a) | simd::sign_bits(x.b) << 4;
#endif
}
KAAMOS_INLINE bool any_lane(const lanes& x) {
#ifdef __AVX2__
  return simd::sign_bits(x.a) != 0;
#else
  return simd::sign_bits(x.a | x.b) != 0;
#endif
}
KAAMOS_INLINE bool no_lane(const lanes& x) {
  return !any_lane(x);
}
KAAMOS_INLINE bool every_lane(const lanes& x) {
#ifdef __AVX2__
  return simd::sign_bits(x.a) == simd::kEverySignBit;
#else
  return simd::sign_bits(x.a & x.b) == simd::kEverySignBit;
#endif
}
KAAMOS_INLINE lanes operator&(const lanes& x, const lanes& y) {
  return by_register<bool>([](auto p, auto q) KAAMOS_INLINE_LAMBDA { return p & q; }, x, y);
}
KAAMOS_INLINE lanes operator|(const lanes& x, const lanes& y) {
  return by_register<bool>([](auto p, auto q) KAAMOS_INLINE_LAMBDA { return p | q; }, x, y);
}
KAAMOS_INLINE lanes operator~(const lanes& x) {
  return by_register<bool>([](auto p) KAAMOS_INLINE_LAMBDA { return ~p; }, x);
}

// 0, 1, 2, ...
KAAMOS_INLINE wide<uint32_t> lane_numbers() {
#ifdef __AVX2__
  return {simd::Uints{0, 1, 2, 3, 4, 5, 6, 7}};
#else
  return {simd::Uints{0, 1, 2, 3}, simd::Uints{4, 5, 6, 7}};
#endif
}
// The first `count` lanes, or all of them if there are fewer.
KAAMOS_INLINE lanes first_lanes(uint32_t count) {
  return by_register<bool>([count](auto x) KAAMOS_INLINE_LAMBDA { return x < count; },
                           lane_numbers());
}

// Calls f(lane) for each active lane, in order.
template <class F>
KAAMOS_INLINE void each_lane(const lanes& active, const F& f) {
  for (uint32_t bits = bits_of(active); bits != 0; bits &= bits - 1) f(__builtin_ctz(bits));
}
// f(lane) in each active lane; zeros in the others.
template <class W, class F>
KAAMOS_INLINE W gather_lanes(const lanes& active, const F& f) {
  W out{};
  each_lane(active, [&](int lane) KAAMOS_INLINE_LAMBDA { set(out, lane, f(lane)); });
  return out;
}

// to = from in the active lanes.
template <class T>
KAAMOS_INLINE void blend(wide<T>& to, const wide<T>& from, const lanes& active) {
  if constexpr (simd::is_in_registers<T>) {
    to = by_register<T>([](auto t, auto f, auto m) KAAMOS_INLINE_LAMBDA { return m ? f : t; }, to,
                        from, active);
  } else {
    each_lane(active, [&](int lane) KAAMOS_INLINE_LAMBDA { to.e[lane] = from.e[lane]; });
  }
}
template <class W>
requires requires(W& x, const lanes& active) {
  x.blend(x, active);
}
KAAMOS_INLINE void blend(W& to, const W& from, const lanes& active) {
  to.blend(from, active);
}
template <class T, int N>
KAAMOS_INLINE void blend(vec<T, N>& to, const vec<T, N>& from, const lanes& active) {
  unroll<N>([&](int i) KAAMOS_INLINE_LAMBDA { blend(to.e[i], from.e[i], active); });
}
template <class T, int R, int C>
KAAMOS_INLINE void blend(mat<T, R, C>& to, const mat<T, R, C>& from, const lanes& active) {
  unroll<R>([&](int i) KAAMOS_INLINE_LAMBDA { blend(to.e[i], from.e[i], active); });
}
template <class T, uint32_t N>
KAAMOS_INLINE void blend(array<T, N>& to, const array<T, N>& from, const lanes& active) {
  for (uint32_t i = 0; i < N; ++i) blend(to.e[i], from.e[i], active);
}
// place.ij = value in the active lanes.
template <int... I, class V, class From>
KAAMOS_INLINE void blend_swizzle(V& place, const From& value, const lanes& active) {
  const From copy = value;  // v.xy = v.yx
  int i = 0;
  (blend(component(place, I), component(copy, i++), active), ...);
}
template <int... I, class V, class From>
KAAMOS_INLINE void blend_matrix_swizzle(V& place, const From& value, const lanes& active) {
  const From copy = value;
  int i = 0;
  (blend(place.e[I / 4].e[I % 4], component(copy, i++), active), ...);
}

// ---------------------------------------------------------------------------------------------
// Choices

template <class W>
KAAMOS_INLINE W select(const lanes& condition, const W& a, const W& b) {
  W out = b;
  blend(out, a, condition);
  return out;
}
template <class T, int N>
KAAMOS_INLINE vec<wide<T>, N> select(const vec<lanes, N>& condition, const vec<wide<T>, N>& a,
                                     const vec<wide<T>, N>& b) {
  vec<wide<T>, N> out = b;
  unroll<N>([&](int i) KAAMOS_INLINE_LAMBDA { blend(out.e[i], a.e[i], condition.e[i]); });
  return out;
}
template <class T, int R, int C>
KAAMOS_INLINE mat<wide<T>, R, C> select(const mat<lanes, R, C>& condition,
                                        const mat<wide<T>, R, C>& a, const mat<wide<T>, R, C>& b) {
  mat<wide<T>, R, C> out = b;
  unroll<R>([&](int i) KAAMOS_INLINE_LAMBDA { out.e[i] = select(condition.e[i], a.e[i], b.e[i]); });
  return out;
}

// condition ? a(lanes) : b(lanes), each called with the lanes that need it.
template <class W, class A, class B>
KAAMOS_INLINE W choose(const lanes& active, const lanes& condition, const A& a, const B& b) {
  const lanes first = active & condition;
  const lanes second = active & ~condition;
  if (no_lane(second)) return a(first);
  if (no_lane(first)) return b(second);
  return select(condition, a(first), b(second));
}
// a && b(lanes), a || b(lanes)
template <class B>
KAAMOS_INLINE lanes both(const lanes& active, const lanes& a, const B& b) {
  const lanes rest = active & a;
  return no_lane(rest) ? rest : rest & b(rest);
}
template <class B>
KAAMOS_INLINE lanes either(const lanes& active, const lanes& a, const B& b) {
  const lanes rest = active & ~a;
  return no_lane(rest) ? a : a | (rest & b(rest));
}

// ---------------------------------------------------------------------------------------------
// Subscripts with a different value in each lane. [convert.h: Subscripts]

template <class W, class V, class I>
KAAMOS_INLINE W element_at(const V& v, const wide<I>& index) {
  W out{};
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto i = static_cast<uint32_t>(get(index, lane));
    if (i >= subscript<V>::count) continue;
    if constexpr (std::is_same_v<subscript_of<V>, W>) {
      set(out, lane, get(v.e[i], lane));
    } else {
      set(out, lane, v.e[i]);
    }
  }
  return out;
}

}  // namespace kaamos::shader
