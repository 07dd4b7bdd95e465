// SPDX-License-Identifier: MIT
//
// Computes what a wave operation gives to each lane, from the values of all lanes that take part.
// Lanes are combined in ascending order, so that a sum of floats is the same on every run.
#pragma once

#include "kaamos/shader/intrinsics_scalar.h"
#include "kaamos/shader/operators.h"
#include "kaamos/shader/wave_op.h"

namespace kaamos::shader {
namespace wave {

template <class F>
KAAMOS_INLINE void each(uint32_t lanes, const F& f) {
  for (; lanes != 0; lanes &= lanes - 1) f(static_cast<uint32_t>(__builtin_ctz(lanes)));
}
KAAMOS_CONSTEXPR uint32_t before(uint32_t lane) {
  return (1u << lane) - 1;
}
KAAMOS_CONSTEXPR uint32_t count(uint32_t lanes) {
  return static_cast<uint32_t>(__builtin_popcount(lanes));
}

template <class T>
KAAMOS_CONSTEXPR T one() {
  if constexpr (is_half<T>) {
    return half{0x3C00};
  } else {
    return static_cast<T>(1);
  }
}

// Operands and results of one wave: component c of lane i is at index c * stride + i.
template <class T>
struct Operands {
  uint32_t active;
  uint32_t stride;
  uint32_t components;
  const T* value;
  const uint32_t* second;
  void* result;

  template <class R>
  R* results() const {
    return static_cast<R*>(result);
  }
};

// f(component's values, component's results)
template <class T, class R, class F>
KAAMOS_INLINE void each_component(const Operands<T>& o, const F& f) {
  for (uint32_t c = 0; c < o.components; ++c) {
    f(o.value + c * o.stride, o.template results<R>() + c * o.stride);
  }
}

template <class Op, class T>
KAAMOS_INLINE void reduce(const Operands<T>& o) {
  each_component<T, T>(o, [&](const T* in, T* out) {
    const uint32_t first = static_cast<uint32_t>(__builtin_ctz(o.active));
    T total = in[first];
    each(o.active & (o.active - 1), [&](uint32_t i) { total = Op::apply(total, in[i]); });
    each(o.active, [&](uint32_t i) { out[i] = total; });
  });
}

// Over the lanes of `of(i)` before lane i.
template <class Op, class T, class Of>
KAAMOS_INLINE void prefix(const Operands<T>& o, T start, const Of& of) {
  each_component<T, T>(o, [&](const T* in, T* out) {
    each(o.active, [&](uint32_t i) {
      T total = start;
      each(of(i) & o.active & before(i), [&](uint32_t j) { total = Op::apply(total, in[j]); });
      out[i] = total;
    });
  });
}

// The value of lane from(i), or zero if that lane takes no part.
template <class T, class From>
KAAMOS_INLINE void read(const Operands<T>& o, const From& from) {
  each_component<T, T>(o, [&](const T* in, T* out) {
    each(o.active, [&](uint32_t i) {
      const uint32_t source = from(i);
      const bool there = source < kMostWaveLanes && (o.active >> source & 1u) != 0;
      out[i] = there ? in[source] : T{};
    });
  });
}

template <class T>
KAAMOS_INLINE void put_mask(const Operands<T>& o, uint32_t lane, uint32_t mask) {
  uint32_t* const out = o.template results<uint32_t>();
  out[lane] = mask;
  for (uint32_t word = 1; word < 4; ++word) out[word * o.stride + lane] = 0;
}

// Operations on a bool.
inline void votes(WaveOp op, const Operands<bool>& o) {
  uint32_t yes = 0;
  each(o.active, [&](uint32_t i) { yes |= static_cast<uint32_t>(o.value[i]) << i; });
  bool* const flags = o.results<bool>();
  uint32_t* const counts = o.results<uint32_t>();
  each(o.active, [&](uint32_t i) {
    const uint32_t quad = 0xFu << (i & ~3u);
    switch (op) {
      case WaveOp::kAnyTrue:
        flags[i] = yes != 0;
        break;
      case WaveOp::kAllTrue:
        flags[i] = yes == o.active;
        break;
      case WaveOp::kQuadAny:
        flags[i] = (yes & quad) != 0;
        break;
      case WaveOp::kQuadAll:
        flags[i] = (yes & quad) == (o.active & quad);
        break;
      case WaveOp::kBallot:
        put_mask(o, i, yes);
        break;
      case WaveOp::kCountBits:
        counts[i] = count(yes);
        break;
      case WaveOp::kPrefixCountBits:
        counts[i] = count(yes & before(i));
        break;
      default:  // kMultiPrefixCountBits
        counts[i] = count(yes & before(i) & o.second[i]);
        break;
    }
  });
}

template <class T>
KAAMOS_INLINE void match(const Operands<T>& o) {
  each(o.active, [&](uint32_t i) {
    uint32_t same = 1u << i;  // a NaN matches itself only
    each(o.active, [&](uint32_t j) {
      bool all = true;
      for (uint32_t c = 0; c < o.components; ++c) {
        const T* const in = o.value + c * o.stride;
        all = all && op::Equal::apply(in[i], in[j]);
      }
      same |= static_cast<uint32_t>(all) << j;
    });
    put_mask(o, i, same);
  });
}

template <class T>
KAAMOS_INLINE void all_equal(const Operands<T>& o) {
  each_component<T, bool>(o, [&](const T* in, bool* out) {
    const uint32_t first = static_cast<uint32_t>(__builtin_ctz(o.active));
    bool all = true;
    each(o.active, [&](uint32_t i) { all = all && op::Equal::apply(in[first], in[i]); });
    each(o.active, [&](uint32_t i) { out[i] = all; });
  });
}

template <class T>
KAAMOS_INLINE void bits(WaveOp op, const Operands<T>& o) {
  const auto mask = [&](uint32_t i) { return o.second[i]; };
  switch (op) {
    case WaveOp::kBitAnd:
      return reduce<op::BitAnd>(o);
    case WaveOp::kBitOr:
      return reduce<op::BitOr>(o);
    case WaveOp::kBitXor:
      return reduce<op::BitXor>(o);
    case WaveOp::kMultiPrefixBitAnd:
      return prefix<op::BitAnd>(o, static_cast<T>(~T{0}), mask);
    case WaveOp::kMultiPrefixBitOr:
      return prefix<op::BitOr>(o, T{0}, mask);
    default:  // kMultiPrefixBitXor
      return prefix<op::BitXor>(o, T{0}, mask);
  }
}

template <class T>
KAAMOS_INLINE void numbers(WaveOp op, const Operands<T>& o) {
  const auto mask = [&](uint32_t i) { return o.second[i]; };
  const auto every = [](uint32_t) { return 0xFFFFFFFFu; };
  switch (op) {
    case WaveOp::kSum:
      return reduce<op::Add>(o);
    case WaveOp::kProduct:
      return reduce<op::Multiply>(o);
    case WaveOp::kMin:
      return reduce<op::Min>(o);
    case WaveOp::kMax:
      return reduce<op::Max>(o);
    case WaveOp::kPrefixSum:
      return prefix<op::Add>(o, T{}, every);
    case WaveOp::kPrefixProduct:
      return prefix<op::Multiply>(o, one<T>(), every);
    case WaveOp::kMultiPrefixSum:
      return prefix<op::Add>(o, T{}, mask);
    case WaveOp::kMultiPrefixProduct:
      return prefix<op::Multiply>(o, one<T>(), mask);
    default:
      if constexpr (is_integer<T>) bits(op, o);
  }
}

// Where one of the two lanes takes no part, the difference is 0.
template <class T>
KAAMOS_INLINE void derivative(WaveOp op, const Operands<T>& o) {
  const bool across = op == WaveOp::kDdxCoarse || op == WaveOp::kDdxFine;
  const bool fine = op == WaveOp::kDdxFine || op == WaveOp::kDdyFine;
  const uint32_t step = across ? 1 : 2;
  each_component<T, T>(o, [&](const T* in, T* out) {
    each(o.active, [&](uint32_t i) {
      const uint32_t first = i & ~(fine ? step : 3u);
      const uint32_t pair = 1u << first | 1u << (first + step);
      const bool there = (o.active & pair) == pair;
      out[i] = there ? op::Subtract::apply(in[first + step], in[first]) : T{};
    });
  });
}

}  // namespace wave

// For every operation that is not answered at once.
template <class T>
KAAMOS_INLINE void wave_results(WaveOp op, const wave::Operands<T>& o) {
  switch (op) {
    case WaveOp::kIsFirstLane: {
      bool* const out = o.template results<bool>();
      wave::each(o.active, [&](uint32_t i) { out[i] = (o.active & wave::before(i)) == 0; });
      return;
    }
    case WaveOp::kAllEqual:
      return wave::all_equal(o);
    case WaveOp::kMatch:
      return wave::match(o);
    case WaveOp::kReadLaneAt:
      return wave::read(o, [&](uint32_t i) { return o.second[i]; });
    case WaveOp::kReadLaneFirst:
      return wave::read(o,
                        [&](uint32_t) { return static_cast<uint32_t>(__builtin_ctz(o.active)); });
    case WaveOp::kQuadReadLaneAt:
      return wave::read(o, [&](uint32_t i) { return (i & ~3u) | (o.second[i] & 3u); });
    case WaveOp::kQuadReadAcrossX:
      return wave::read(o, [](uint32_t i) { return i ^ 1u; });
    case WaveOp::kQuadReadAcrossY:
      return wave::read(o, [](uint32_t i) { return i ^ 2u; });
    case WaveOp::kQuadReadAcrossDiagonal:
      return wave::read(o, [](uint32_t i) { return i ^ 3u; });
    case WaveOp::kDdxCoarse:
    case WaveOp::kDdyCoarse:
    case WaveOp::kDdxFine:
    case WaveOp::kDdyFine:
      if constexpr (!std::is_same_v<T, bool>) wave::derivative(op, o);
      return;
    default:
      break;
  }
  if constexpr (std::is_same_v<T, bool>) {
    wave::votes(op, o);
  } else {
    wave::numbers(op, o);
  }
}

}  // namespace kaamos::shader
