// SPDX-License-Identifier: MIT
//
// Writes the colours of two quads to the render targets. [D3D11.3: 17]
#pragma once

#include <algorithm>
#include <bit>

#include "runtime/raster/blend.h"
#include "runtime/raster/draw_plan.h"
#include "runtime/raster/fast_encode.h"
#include "runtime/raster/lanes.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

using QuadWord [[gnu::vector_size(16)]] = uint32_t;
using QuadRows [[gnu::vector_size(16)]] = uint64_t;

// Two quads in the targets.
struct QuadPlaces {
  uint32_t x[2];  // of the first pixel
  uint32_t y[2];
  uint32_t slice;
  bool inside[2];  // all pixels are in all targets
};

// Their pixels that are written.
struct LivePixels {
  uint32_t bits;
  QuadWord mask[2];

  explicit LivePixels(uint32_t live) : bits(live) {
    constexpr QuadWord kEach = {1, 2, 4, 8};
    for (uint32_t i = 0; i < 2; ++i) {
      mask[i] = (QuadWord)(((QuadWord{} + (live >> 4 * i)) & kEach) == kEach);
    }
  }
  uint32_t of(uint32_t quad) const { return bits >> 4 * quad & 0xF; }
};

// Calls f(texel, lane) for the pixels of `live`.
template <class F>
KAAMOS_INLINE void each_target_texel(const PlannedTarget& target, const QuadPlaces& places,
                                     uint32_t live, const F& f) {
  const Surface& surface = *target.surface;
  const uint32_t bytes = target.codec->bytes;
  for (uint32_t rest = live; rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<uint32_t>(std::countr_zero(rest));
    const uint32_t quad = lane / 4;
    const uint64_t x = places.x[quad] + (lane & 1);
    const uint64_t y = places.y[quad] + (lane >> 1 & 1);
    f(surface.texels + places.slice * surface.slice_pitch + y * surface.row_pitch + x * bytes,
      lane);
  }
}

template <uint32_t kBytes>
inline void read_texels(const PlannedTarget& target, const QuadPlaces& places, uint32_t live,
                        shader::Column* words) {
  each_target_texel(target, places, live, [&](const uint8_t* texel, uint32_t lane) {
    constexpr uint32_t kWords = (kBytes + 3) / 4;
    uint32_t values[kWords] = {};
    __builtin_memcpy(values, texel, kBytes);
    for (uint32_t w = 0; w < kWords; ++w) words[w][lane] = values[w];
  });
}
// Four texels of 4 or 8 bytes; those whose `mask` is clear stay. Without a branch for whole quads,
// which half of them are, because nothing predicts them.
template <uint32_t kBytes>
KAAMOS_INLINE void write_quad(uint8_t* texel, uint64_t row_pitch, const shader::Column* words,
                              uint32_t lane, QuadWord mask) {
  QuadWord first;
  __builtin_memcpy(&first, words[0] + lane, 16);
  if constexpr (kBytes == 4) {
    uint64_t above, below;
    __builtin_memcpy(&above, texel, 8);
    __builtin_memcpy(&below, texel + row_pitch, 8);
    const QuadRows old = {above, below};
    const QuadRows rows = ((QuadRows)first & (QuadRows)mask) | (old & ~(QuadRows)mask);
    above = rows[0];
    below = rows[1];
    __builtin_memcpy(texel, &above, 8);
    __builtin_memcpy(texel + row_pitch, &below, 8);
  } else {
    QuadWord second;
    __builtin_memcpy(&second, words[1] + lane, 16);
    const QuadWord rows[2] = {__builtin_shufflevector(first, second, 0, 4, 1, 5),
                              __builtin_shufflevector(first, second, 2, 6, 3, 7)};
    const QuadWord masks[2] = {__builtin_shufflevector(mask, mask, 0, 0, 1, 1),
                               __builtin_shufflevector(mask, mask, 2, 2, 3, 3)};
    for (uint32_t row = 0; row < 2; ++row) {
      QuadWord old;
      __builtin_memcpy(&old, texel + row * row_pitch, 16);
      const QuadWord both = (rows[row] & masks[row]) | (old & ~masks[row]);
      __builtin_memcpy(texel + row * row_pitch, &both, 16);
    }
  }
}

// Whole quads at once, pixel by pixel only at the target's border and for other sizes of texels.
template <uint32_t kBytes>
KAAMOS_INLINE void write_texels(const PlannedTarget& target, const QuadPlaces& places,
                                const LivePixels& live, const shader::Column* words) {
  uint32_t rest = live.bits;
  if constexpr (kBytes == 4 || kBytes == 8) {
    const Surface& surface = *target.surface;
    uint8_t* texels = surface.texels + places.slice * surface.slice_pitch;
    const uint64_t row_pitch = surface.row_pitch;
    for (uint32_t quad = 0; quad < 2; ++quad) {
      const uint32_t bits = live.of(quad);
      if (bits == 0 || !places.inside[quad]) continue;
      rest &= ~(0xFu << 4 * quad);
      uint8_t* texel = texels + places.y[quad] * row_pitch + uint64_t{places.x[quad]} * kBytes;
      write_quad<kBytes>(texel, row_pitch, words, 4 * quad, live.mask[quad]);
    }
    if (rest == 0) return;
  }
  each_target_texel(target, places, rest, [&](uint8_t* texel, uint32_t lane) {
    constexpr uint32_t kWords = (kBytes + 3) / 4;
    uint32_t values[kWords];
    for (uint32_t w = 0; w < kWords; ++w) values[w] = words[w][lane];
    __builtin_memcpy(texel, values, kBytes);
  });
}

// Calls f with the number of bytes of a texel as a constant.
template <class F>
KAAMOS_INLINE void with_bytes(uint32_t bytes, const F& f) {
  switch (bytes) {
    case 1:
      return f(std::integral_constant<uint32_t, 1>());
    case 2:
      return f(std::integral_constant<uint32_t, 2>());
    case 4:
      return f(std::integral_constant<uint32_t, 4>());
    case 8:
      return f(std::integral_constant<uint32_t, 8>());
    default:
      return f(std::integral_constant<uint32_t, 16>());
  }
}

inline void write_target(const DrawPlan& plan, const PlannedTarget& target,
                         const QuadPlaces& places, const shader::Column* outputs,
                         const LivePixels& live) {
  const TargetCodec& codec = *target.codec;
  alignas(32) shader::Column components[4];
  const shader::Column* colors = outputs + target.first_column;
  if (target.components < (target.blends ? 4 : codec.columns)) {
    for (uint32_t c = 0; c < 4; ++c) {
      store(components[c], c < target.components ? load<int32_t>(colors[c]) : Ints8{});
    }
    colors = components;
  }
  alignas(32) shader::Column words[4];
  if (target.whole_texels && !target.blends) {
    encode_colors(codec, colors, words);
  } else {
    alignas(32) shader::Column old[4] = {};
    with_bytes(codec.bytes,
               [&](auto bytes) { read_texels<bytes>(target, places, live.bits, old); });
    alignas(32) shader::Column blended[4];
    if (target.blends) {
      alignas(32) shader::Column destination[4];
      codec.decode(old, destination);
      blend_colors(target.blend, codec, plan.blend_factor, colors, destination, blended);
      colors = blended;
    }
    encode_colors(codec, colors, words);
    for (uint32_t w = 0; w < codec.words; ++w) {
      for (int i = 0; i < shader::kGraphicsLanes; ++i) {
        words[w][i] = (words[w][i] & target.mask[w]) | (old[w][i] & ~target.mask[w]);
      }
    }
  }
  with_bytes(codec.bytes, [&](auto bytes) { write_texels<bytes>(target, places, live, words); });
}

// Asks for the texels of a rectangle before they are written.
inline void prefetch_targets(const DrawPlan& plan, uint32_t x, uint32_t y, uint32_t slice,
                             uint32_t columns, uint32_t rows) {
  constexpr uint32_t kCacheLine = 64;
  for (const PlannedTarget& target : plan.targets) {
    const Surface& surface = *target.surface;
    const uint64_t bytes = uint64_t{columns} * target.codec->bytes;
    for (uint32_t row = 0; row < rows; ++row) {
      const uint8_t* texels = surface.texels + slice * surface.slice_pitch +
                              uint64_t{y + row} * surface.row_pitch +
                              uint64_t{x} * target.codec->bytes;
      for (uint64_t byte = 0; byte < bytes; byte += kCacheLine)
        __builtin_prefetch(texels + byte, 1);
    }
  }
}

// `outputs`: the pixel shader's columns.
inline void write_targets(const DrawPlan& plan, const QuadPlaces& places,
                          const shader::Column* outputs, uint32_t bits) {
  const LivePixels live(bits);
  for (const PlannedTarget& target : plan.targets) {
    write_target(plan, target, places, outputs, live);
  }
}

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
