// SPDX-License-Identifier: MIT
//
// The most common formats of render targets, eight texels at a time: the words of
// TargetCodec::encode, as put(number of the word, words).
#pragma once

#include "runtime/raster/lanes.h"
#include "runtime/raster/srgb_table.h"
#include "runtime/raster/target_codec.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

// NaN is 0.
KAAMOS_INLINE Floats8 saturated(const shader::Column& column) {
  return smaller(larger(load<float>(column), splat(0.0f)), splat(1.0f));
}
KAAMOS_INLINE Ints8 to_bytes(const Floats8& value) {
  return to_ints(value * splat(255.0f) + splat(0.5f));
}
template <int kShift>
KAAMOS_INLINE Ints8 shifted(const Ints8& x) {
  return by_register<int32_t>([](auto r) KAAMOS_INLINE_LAMBDA { return r << kShift; }, x);
}

// A bucket of the table holds at most one border between two values.
KAAMOS_INLINE Ints8 to_srgb(const SrgbTable& table, const Floats8& value) {
  const Ints8 bucket = to_ints(value * splat(static_cast<float>(SrgbTable::kBuckets)));
  int32_t buckets[8];
  float values[8];
  int32_t out[8];
  store(buckets, bucket);
  store(values, value);
  for (int i = 0; i < 8; ++i) {
    const SrgbTable::Bucket& entry = table.buckets[buckets[i]];
    out[i] = entry.value + (values[i] >= entry.border ? 1 : 0);
  }
  return load<int32_t>(out);
}

KAAMOS_INLINE Ints8 magnitude_of(const shader::Column& column) {
  return load<int32_t>(column) & splat(0x7FFFFFFF);
}
// As half_toward_zero() of finite numbers.
KAAMOS_INLINE Ints8 to_halves(const shader::Column& column) {
  return by_register<int32_t>(
      [](simd::Ints bits) KAAMOS_INLINE_LAMBDA {
        const simd::Ints magnitude = bits & 0x7FFFFFFF;
        const simd::Ints sign = (simd::Ints)((simd::Uints)bits >> 16) & 0x8000;
        const simd::Ints is_small = magnitude < 0x38800000;
        const simd::Floats small = (simd::Floats)(magnitude & is_small) * 0x1p24f;
        const simd::Ints denormal = __builtin_convertvector(small, simd::Ints);
        const simd::Ints largest = simd::Ints{} + 0x477FE000;
        const simd::Ints cut = magnitude < largest ? magnitude : largest;
        const simd::Ints normal = (cut - 0x38000000) >> 13;
        return (is_small ? denormal : normal) | sign;
      },
      load<int32_t>(column));
}
// As TargetCodec::encode.
template <class Put>
KAAMOS_INLINE void encode_any(const TargetCodec& codec, const shader::Column* colors,
                              const Put& put) {
  alignas(32) shader::Column words[4];
  codec.encode(colors, words);
  for (uint32_t w = 0; w < codec.words; ++w) put(w, load<int32_t>(words[w]));
}

template <class Put>
KAAMOS_INLINE void encode_halves(const TargetCodec& codec, const shader::Column* colors,
                                 const Put& put) {
  Ints8 largest{};
  for (uint32_t c = 0; c < codec.columns; ++c) {
    const Ints8 magnitude = magnitude_of(colors[c]);
    largest = choose(less(largest, magnitude), magnitude, largest);
  }
  // Infinity or NaN.
  if (shader::any_lane(less(splat(0x7F7FFFFF), largest))) return encode_any(codec, colors, put);
  for (uint32_t w = 0; w < codec.words; ++w) {
    put(w, to_halves(colors[2 * w]) | shifted<16>(to_halves(colors[2 * w + 1])));
  }
}

template <int kRed, int kBlue, bool kSrgb, class Put>
KAAMOS_INLINE void encode_bytes(const shader::Column* colors, const Put& put) {
  const SrgbTable* table = kSrgb ? &srgb_table() : nullptr;
  const auto channel = [&](int c) KAAMOS_INLINE_LAMBDA {
    const Floats8 value = saturated(colors[c]);
    return kSrgb ? to_srgb(*table, value) : to_bytes(value);
  };
  put(0, shifted<kRed>(channel(0)) | shifted<8>(channel(1)) | shifted<kBlue>(channel(2)) |
             shifted<24>(to_bytes(saturated(colors[3]))));
}

template <class Put>
KAAMOS_INLINE void encode_colors(const TargetCodec& codec, const shader::Column* colors,
                                 const Put& put) {
  switch (codec.fast) {
    case FastEncode::kWords:
      for (uint32_t w = 0; w < codec.words; ++w) put(w, load<int32_t>(colors[w]));
      break;
    case FastEncode::kHalves:
      encode_halves(codec, colors, put);
      break;
    case FastEncode::kRgba8:
      encode_bytes<0, 16, false>(colors, put);
      break;
    case FastEncode::kRgba8Srgb:
      encode_bytes<0, 16, true>(colors, put);
      break;
    case FastEncode::kBgra8:
      encode_bytes<16, 0, false>(colors, put);
      break;
    case FastEncode::kBgra8Srgb:
      encode_bytes<16, 0, true>(colors, put);
      break;
    default:
      encode_any(codec, colors, put);
  }
}

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
