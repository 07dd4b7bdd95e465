// SPDX-License-Identifier: MIT
//
// Texels and system values of several threads. Lanes that are side by side in a row of a texture,
// as those of neighbouring threads mostly are, are read and written at once; others one by one.
#pragma once

#include "kaamos/shader/bound.h"
#include "kaamos/shader/system_values.h"
#include "kaamos/shader/wide_operators.h"

namespace kaamos::shader {

// The wide form of a numeric type.
template <class V>
using Wide = with_scalar<V, wide<scalar_of<V>>>;

// Tells whether lanes read a row of texels in order, starting at x, y. Coordinates that differ from
// known ones by the same offset in every lane need no new check: a shader that reads the neighbours
// of its pixel only has to check the pixel itself.
struct TexelRow {
  bool in_order;
  uint32_t x, y;
};
template <class C>
KAAMOS_INLINE TexelRow texel_row(const vec<wide<C>, 2>& at) {
  const auto x = convert<uint32_t>(at.e[0]), y = convert<uint32_t>(at.e[1]);
  const uint32_t first = get(x, 0), row = get(y, 0);
  const lanes in_order =
      map<op::Equal>(x, map<op::Add>(spread<wide<uint32_t>>(first), lane_numbers())) &
      map<op::Equal>(y, spread<wide<uint32_t>>(row));
  return {every_lane(in_order), first, row};
}
template <class C>
KAAMOS_INLINE TexelRow moved(const TexelRow& row, const vec<C, 2>& by) {
  return {row.in_order, row.x + static_cast<uint32_t>(by.e[0]),
          row.y + static_cast<uint32_t>(by.e[1])};
}

namespace simd {

#ifdef __AVX2__
using Quad [[gnu::vector_size(16)]] = float;

// Lanes i and i + 4 of four components, from the texels of eight lanes.
KAAMOS_INLINE Floats pair(const uint8_t* texels, int lane) {
  Quad low, high;
  __builtin_memcpy(&low, texels + 16 * lane, 16);
  __builtin_memcpy(&high, texels + 16 * (lane + 4), 16);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
KAAMOS_INLINE Floats low_pairs(Floats x, Floats y) {
  return __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13);
}
KAAMOS_INLINE Floats high_pairs(Floats x, Floats y) {
  return __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15);
}
KAAMOS_INLINE Floats low_halves(Floats x, Floats y) {
  return __builtin_shufflevector(x, y, 0, 1, 8, 9, 4, 5, 12, 13);
}
KAAMOS_INLINE Floats high_halves(Floats x, Floats y) {
  return __builtin_shufflevector(x, y, 2, 3, 10, 11, 6, 7, 14, 15);
}
#else
KAAMOS_INLINE Floats low_pairs(Floats x, Floats y) {
  return __builtin_shufflevector(x, y, 0, 4, 1, 5);
}
KAAMOS_INLINE Floats high_pairs(Floats x, Floats y) {
  return __builtin_shufflevector(x, y, 2, 6, 3, 7);
}
KAAMOS_INLINE Floats low_halves(Floats x, Floats y) {
  return __builtin_shufflevector(x, y, 0, 1, 4, 5);
}
KAAMOS_INLINE Floats high_halves(Floats x, Floats y) {
  return __builtin_shufflevector(x, y, 2, 3, 6, 7);
}
#endif

// Turns the rows of a 4 x 4 matrix into columns, in each 16 bytes of the registers.
KAAMOS_INLINE void transpose(Floats (&r)[4]) {
  const Floats ab = low_pairs(r[0], r[1]), ab_high = high_pairs(r[0], r[1]);
  const Floats cd = low_pairs(r[2], r[3]), cd_high = high_pairs(r[2], r[3]);
  r[0] = low_halves(ab, cd);
  r[1] = high_halves(ab, cd);
  r[2] = low_halves(ab_high, cd_high);
  r[3] = high_halves(ab_high, cd_high);
}

template <class T>
KAAMOS_INLINE wide<T> load_words(const uint8_t* from) {
  static_assert(is_number<T> && sizeof(wide<T>) == 4 * kLanes);
  wide<T> out;
  __builtin_memcpy(&out, from, sizeof(out));
  return out;
}
template <class T>
KAAMOS_INLINE void store_words(uint8_t* to, const wide<T>& words) {
  static_assert(is_number<T> && sizeof(words) == 4 * kLanes);
  __builtin_memcpy(to, &words, sizeof(words));
}

// Transposes from the value of one lane after another to the wide value.
template <class W>
KAAMOS_INLINE W from_rows(const Lane<W>* rows) {
  constexpr uint32_t kBytes = sizeof(Lane<W>);
  static_assert(is_words<W> && sizeof(W) == kLanes * kBytes && kBytes >= 16);
  const auto* from = reinterpret_cast<const uint8_t*>(rows);
  W out;
  auto* to = reinterpret_cast<uint8_t*>(&out);
  constexpr uint32_t kQuads = (kBytes + 15) / 16;
  for (uint32_t quad = 0; quad < kQuads; ++quad) {
    // The last four words may overlap the ones before.
    const uint32_t at = 16 * quad < kBytes - 16 ? 16 * quad : kBytes - 16;
    for (int i = 0; i < kLanes; i += kRegisterBytes / 4) {
      Floats r[4];
      for (int k = 0; k < 4; ++k) {
        const uint8_t* row = from + static_cast<uint32_t>(i + k) * kBytes + at;
        __builtin_memcpy(&r[k], row, 16);
#ifdef __AVX2__
        __builtin_memcpy(reinterpret_cast<uint8_t*>(&r[k]) + 16, row + 4 * kBytes, 16);
#endif
      }
      transpose(r);
      for (int k = 0; k < 4; ++k) {
        __builtin_memcpy(to + (at + 4 * static_cast<uint32_t>(k)) * kLanes + 4 * i, &r[k],
                         sizeof(r[k]));
      }
    }
  }
  return out;
}

// Loads adjacent texels of 1, 2 or 4 components of T.
template <class T>
KAAMOS_INLINE wide<T> load_row(const uint8_t* from, wide<T>*) {
  return load_words<T>(from);
}
template <class T>
KAAMOS_INLINE vec<wide<T>, 2> load_row(const uint8_t* from, vec<wide<T>, 2>*) {
  const auto low = load_words<T>(from), high = load_words<T>(from + 4 * kLanes);
#ifdef __AVX2__
  return {{{__builtin_shufflevector(low.a, high.a, 0, 2, 4, 6, 8, 10, 12, 14)},
           {__builtin_shufflevector(low.a, high.a, 1, 3, 5, 7, 9, 11, 13, 15)}}};
#else
  return {{{__builtin_shufflevector(low.a, low.b, 0, 2, 4, 6),
            __builtin_shufflevector(high.a, high.b, 0, 2, 4, 6)},
           {__builtin_shufflevector(low.a, low.b, 1, 3, 5, 7),
            __builtin_shufflevector(high.a, high.b, 1, 3, 5, 7)}}};
#endif
}
template <class T>
KAAMOS_INLINE vec<wide<T>, 4> load_row(const uint8_t* from, vec<wide<T>, 4>*) {
  using R = Register<T>;
#ifdef __AVX2__
  Floats r[4] = {pair(from, 0), pair(from, 1), pair(from, 2), pair(from, 3)};
  transpose(r);
  return {{{(R)r[0]}, {(R)r[1]}, {(R)r[2]}, {(R)r[3]}}};
#else
  Floats a[4], b[4];
  __builtin_memcpy(a, from, sizeof(a));
  __builtin_memcpy(b, from + sizeof(a), sizeof(b));
  transpose(a);
  transpose(b);
  return {{{(R)a[0], (R)b[0]}, {(R)a[1], (R)b[1]}, {(R)a[2], (R)b[2]}, {(R)a[3], (R)b[3]}}};
#endif
}

template <class T>
KAAMOS_INLINE void store_row(uint8_t* to, const wide<T>& value) {
  store_words(to, value);
}
template <class T>
KAAMOS_INLINE void store_row(uint8_t* to, const vec<wide<T>, 2>& value) {
  const auto &x = value.e[0], &y = value.e[1];
#ifdef __AVX2__
  store_words<T>(to, {__builtin_shufflevector(x.a, y.a, 0, 8, 1, 9, 2, 10, 3, 11)});
  store_words<T>(to + 4 * kLanes, {__builtin_shufflevector(x.a, y.a, 4, 12, 5, 13, 6, 14, 7, 15)});
#else
  store_words<T>(to, {__builtin_shufflevector(x.a, y.a, 0, 4, 1, 5),
                      __builtin_shufflevector(x.a, y.a, 2, 6, 3, 7)});
  store_words<T>(to + 4 * kLanes, {__builtin_shufflevector(x.b, y.b, 0, 4, 1, 5),
                                   __builtin_shufflevector(x.b, y.b, 2, 6, 3, 7)});
#endif
}
template <class T>
KAAMOS_INLINE void store_row(uint8_t* to, const vec<wide<T>, 4>& value) {
  Floats r[4] = {(Floats)value.e[0].a, (Floats)value.e[1].a, (Floats)value.e[2].a,
                 (Floats)value.e[3].a};
  transpose(r);
#ifdef __AVX2__
  for (int i = 0; i < 4; ++i) {
    const Quad low = __builtin_shufflevector(r[i], r[i], 0, 1, 2, 3);
    const Quad high = __builtin_shufflevector(r[i], r[i], 4, 5, 6, 7);
    __builtin_memcpy(to + 16 * i, &low, 16);
    __builtin_memcpy(to + 16 * (i + 4), &high, 16);
  }
#else
  __builtin_memcpy(to, r, sizeof(r));
  Floats s[4] = {(Floats)value.e[0].b, (Floats)value.e[1].b, (Floats)value.e[2].b,
                 (Floats)value.e[3].b};
  transpose(s);
  __builtin_memcpy(to + sizeof(r), s, sizeof(s));
#endif
}

// The first texel of the lanes, if they are in order, have `bytes` bytes each and are all inside
// the texture; otherwise null.
KAAMOS_INLINE uint8_t* first_texel(const BoundResource& texture, const TexelRow& row,
                                   uint32_t bytes) {
  if (!row.in_order || row.y >= texture.height || texture.width < uint32_t{kLanes} ||
      row.x > texture.width - uint32_t{kLanes}) {
    return nullptr;
  }
  return texture.texels + static_cast<uint64_t>(row.y) * texture.row_pitch +
         uint64_t{row.x} * bytes;
}

// Rows of the short formats. [texture_access.h: load_short]
KAAMOS_INLINE vec<wide<float>, 2> load_snorm16_row(const uint8_t* from) {
  const auto words = load_words<int32_t>(from);
  const auto part = [&words](int shift) KAAMOS_INLINE_LAMBDA {
    return by_register<float>(
        [shift](Ints x) KAAMOS_INLINE_LAMBDA {
          const Floats f = __builtin_convertvector((x << shift) >> 16, Floats) / 32767.0f;
          return f < -1.0f ? Floats{} - 1.0f : f;
        },
        words);
  };
  return {{part(16), part(0)}};
}
KAAMOS_INLINE vec<wide<float>, 4> load_unorm8_row(const uint8_t* from) {
  const auto words = load_words<int32_t>(from);
  const auto part = [&words](int shift) KAAMOS_INLINE_LAMBDA {
    return by_register<float>(
        [shift](Ints x) KAAMOS_INLINE_LAMBDA {
          return __builtin_convertvector((x >> shift) & 0xFF, Floats) / 255.0f;
        },
        words);
  };
  return {{part(0), part(8), part(16), part(24)}};
}

template <class V, class C>
[[gnu::noinline]] inline void load_lanes(const Invocation& invocation, const BoundResource& texture,
                                         const vec<wide<C>, 2>& at, const lanes& active,
                                         Wide<V>& out) {
  out = gather_lanes<Wide<V>>(active, [&](int lane) KAAMOS_INLINE_LAMBDA {
    return load_texel<V>(invocation, texture, texel_coordinates(get(at, lane), 0));
  });
}
template <class V, class C>
[[gnu::noinline]] inline void store_lanes(const Invocation& invocation,
                                          const BoundResource& texture, const vec<wide<C>, 2>& at,
                                          const lanes& active, const Wide<V>& value) {
  each_lane(active, [&](int lane) KAAMOS_INLINE_LAMBDA {
    store_texel<V>(invocation, texture, texel_coordinates(get(at, lane), 0), get(value, lane));
  });
}

}  // namespace simd

// f(at) in each active lane; zeros, or other lanes' values, in the rest. For what lanes read from
// memory: often all read the same, and then it is read only once.
template <class W, class I, class F>
KAAMOS_INLINE W gather_at(const lanes& active, const wide<I>& at, const F& f) {
  if constexpr (sizeof(Lane<W>) < 16) {
    return gather_lanes<W>(active, [&](int lane) KAAMOS_INLINE_LAMBDA { return f(get(at, lane)); });
  } else {
    const uint32_t bits = bits_of(active);
    if (bits == 0) return W{};
    const I first = get(at, __builtin_ctz(bits));
    if ((bits & ~bits_of(map<op::Equal>(at, spread<wide<I>>(first)))) == 0) {
      return spread<W>(f(first));
    }
    if constexpr (is_words<W>) {
      if (bits == (1u << kLanes) - 1) {
        Lane<W> rows[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) rows[lane] = f(get(at, lane));
        return simd::from_rows<W>(rows);
      }
    }
    return gather_lanes<W>(active, [&](int lane) KAAMOS_INLINE_LAMBDA { return f(get(at, lane)); });
  }
}

// Loads texels of mip 0 of a 2-D texture; V is what one lane reads. at() gives the coordinates, and
// `row` what is known about them. Inactive lanes may read what they would read if they were active.
template <class V, class At>
KAAMOS_INLINE Wide<V> load_texels(const Invocation& invocation, const BoundResource& texture,
                                  const TexelRow& row, const At& at, const lanes& active) {
  constexpr uint32_t kFormat = texture_access::direct_format<V>();
  if constexpr (kFormat != 0 && shape<V>::count != 3) {
    if (__builtin_expect(texture.direct_format == kFormat, 1)) {
      if (const uint8_t* first = simd::first_texel(texture, row, sizeof(V))) {
        return simd::load_row(first, static_cast<Wide<V>*>(nullptr));
      }
    } else if constexpr (std::is_same_v<V, vec<float, 2>>) {
      if (texture.direct_format == texture_access::kR16G16Snorm) {
        if (const uint8_t* first = simd::first_texel(texture, row, 4)) {
          return simd::load_snorm16_row(first);
        }
      }
    } else if constexpr (std::is_same_v<V, vec<float, 4>>) {
      if (texture.direct_format == texture_access::kR8G8B8A8Unorm) {
        if (const uint8_t* first = simd::first_texel(texture, row, 4)) {
          return simd::load_unorm8_row(first);
        }
      }
    }
  }
  Wide<V> out;
  simd::load_lanes<V>(invocation, texture, at(), active, out);
  return out;
}
template <class V, class At>
KAAMOS_INLINE void store_texels(const Invocation& invocation, const BoundResource& texture,
                                const TexelRow& row, const At& at, const Wide<V>& value,
                                const lanes& active) {
  constexpr uint32_t kFormat = texture_access::direct_format<V>();
  if constexpr (kFormat != 0 && shape<V>::count != 3) {
    if (texture.direct_format == kFormat && texture.writable && every_lane(active)) {
      if (uint8_t* first = simd::first_texel(texture, row, sizeof(V))) {
        simd::store_row(first, value);
        return;
      }
    }
  }
  simd::store_lanes<V>(invocation, texture, at(), active, value);
}

// The same when nothing is known about the coordinates.
template <class V, class C>
KAAMOS_INLINE Wide<V> load_texels(const Invocation& invocation, const BoundResource& texture,
                                  const vec<wide<C>, 2>& at, const lanes& active) {
  return load_texels<V>(
      invocation, texture, texel_row(at), [&]() KAAMOS_INLINE_LAMBDA { return at; }, active);
}
template <class V, class C>
KAAMOS_INLINE void store_texels(const Invocation& invocation, const BoundResource& texture,
                                const vec<wide<C>, 2>& at, const Wide<V>& value,
                                const lanes& active) {
  store_texels<V>(
      invocation, texture, texel_row(at), [&]() KAAMOS_INLINE_LAMBDA { return at; }, value, active);
}

// DispatchRaysIndex of kLanes adjacent invocations.
KAAMOS_INLINE vec<wide<uint32_t>, 3> wide_rays_index(const Invocation& first) {
  return {{map<op::Add>(spread<wide<uint32_t>>(first.index[0]), lane_numbers()),
           spread<wide<uint32_t>>(first.index[1]), spread<wide<uint32_t>>(first.index[2])}};
}

// Threads first .. first + kLanes - 1 of a group, by SV_GroupIndex.
struct WideThread {
  wide<uint32_t> id[3];  // SV_GroupThreadID
  wide<uint32_t> index;
};
KAAMOS_INLINE WideThread wide_thread(const uint32_t size[3], uint32_t first) {
  WideThread out;
  out.index = map<op::Add>(spread<wide<uint32_t>>(first), lane_numbers());
  if (size[0] % kLanes == 0) {
    out.id[0] = map<op::Add>(spread<wide<uint32_t>>(first % size[0]), lane_numbers());
    out.id[1] = spread<wide<uint32_t>>(first / size[0] % size[1]);
    out.id[2] = spread<wide<uint32_t>>(first / size[0] / size[1]);
    return out;
  }
  for (int lane = 0; lane < kLanes; ++lane) {
    const uint32_t n = first + static_cast<uint32_t>(lane);
    set(out.id[0], lane, n % size[0]);
    set(out.id[1], lane, n / size[0] % size[1]);
    set(out.id[2], lane, n / size[0] / size[1]);
  }
  return out;
}
// W is the parameter's type: one to three wide<uint32_t> or wide<int32_t>.
template <class W>
KAAMOS_INLINE W wide_group_value(const wide<uint32_t> (&value)[3]) {
  W result{};
  for (int i = 0; i < shape<W>::count && i < 3; ++i) {
    component(result, i) = convert<Lane<scalar_of<W>>>(value[i]);
  }
  return result;
}
template <class W>
KAAMOS_INLINE W wide_dispatch_thread_id(const ComputeGroup& group, const uint32_t size[3],
                                        const WideThread& thread) {
  wide<uint32_t> id[3];
  for (int i = 0; i < 3; ++i) {
    id[i] = map<op::Add>(spread<wide<uint32_t>>(group.group_id[i] * size[i]), thread.id[i]);
  }
  return wide_group_value<W>(id);
}

}  // namespace kaamos::shader
