// SPDX-License-Identifier: MIT
//
// Writes the colours of two quads to the render targets' texels in the tile. [D3D11.3: 17]
#pragma once

#include "runtime/raster/blend.h"
#include "runtime/raster/draw_plan.h"
#include "runtime/raster/fast_encode.h"
#include "runtime/raster/lanes.h"
#include "runtime/raster/tile_colors.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

using QuadWord [[gnu::vector_size(16)]] = uint32_t;
using QuadInMemory [[gnu::vector_size(16), gnu::aligned(4), gnu::may_alias]] = uint32_t;

// Two quads of a tile; they may be the same one, of which the second then writes nothing.
struct QuadPlaces {
  uint32_t quad[2];  // number in the tile
};

// Their pixels that are written.
struct LivePixels {
  QuadWord mask[2];

  KAAMOS_INLINE explicit LivePixels(uint32_t live) {
    constexpr QuadWord kEach = {1, 2, 4, 8};
    for (uint32_t i = 0; i < 2; ++i) {
      mask[i] = (QuadWord)(((QuadWord{} + (live >> 4 * i)) & kEach) == kEach);
    }
  }
};

// A target's texels in the tile, as TileColors has them.
struct TileTexels {
  QuadInMemory* words;
  uint32_t words_per_texel;
  QuadPlaces places;

  KAAMOS_INLINE QuadInMemory& at(uint32_t i, uint32_t word) const {
    return words[places.quad[i] * words_per_texel + word];
  }
  KAAMOS_INLINE void read(shader::Column* out) const {
    for (uint32_t w = 0; w < words_per_texel; ++w) {
      for (uint32_t i = 0; i < 2; ++i) *reinterpret_cast<QuadInMemory*>(&out[w][4 * i]) = at(i, w);
    }
  }
  // Without a branch for whole quads, which half of them are, because nothing predicts them.
  KAAMOS_INLINE void write(uint32_t word, const Ints8& value, const LivePixels& live) const {
    const QuadWord halves[2] = {(QuadWord)low_half(value), (QuadWord)high_half(value)};
    for (uint32_t i = 0; i < 2; ++i) {
      QuadInMemory& texels = at(i, word);
      texels = (QuadInMemory)((halves[i] & live.mask[i]) | ((QuadWord)texels & ~live.mask[i]));
    }
  }
};

// Four columns, with 0 in components that the shader does not write.
inline void all_components(const shader::Column* written, uint32_t count, shader::Column out[4]) {
  for (uint32_t c = 0; c < 4; ++c) {
    store(out[c], c < count ? load<int32_t>(written[c]) : Ints8{});
  }
}

inline void write_target(const DrawPlan& plan, const PlannedTarget& target,
                         const TileTexels& texels, const shader::Column* outputs,
                         const LivePixels& live) {
  const TargetCodec& codec = *target.codec;
  alignas(32) shader::Column components[4];
  const shader::Column* colors = outputs + target.first_column;
  if (target.components < (target.blends ? 4 : codec.columns)) {
    all_components(colors, target.components, components);
    colors = components;
  }
  const auto write = [&](uint32_t word, const Ints8& value)
                         KAAMOS_INLINE_LAMBDA { texels.write(word, value, live); };
  if (target.whole_texels && !target.blends) return encode_colors(codec, colors, write);
  alignas(32) shader::Column old[4] = {};
  texels.read(old);
  alignas(32) shader::Column blended[4];
  if (target.blends) {
    alignas(32) shader::Column destination[4];
    codec.decode(old, destination);
    const bool two = plan.linked->blends_two_sources;
    alignas(32) shader::Column second[4];
    if (two) {
      const auto& written = plan.linked->pixel_columns.targets[1];
      const bool any = written.first_column != runtime::kNoColumn;
      all_components(any ? outputs + written.first_column : outputs, written.components, second);
    }
    blend_colors(target.blend, codec, plan.blend_factor, colors, two ? second : nullptr,
                 destination, blended);
    colors = blended;
  }
  encode_colors(codec, colors, [&](uint32_t word, const Ints8& encoded) KAAMOS_INLINE_LAMBDA {
    const auto mask = static_cast<int32_t>(target.mask[word]);
    Ints8 value = encoded;
    if (target.blend.LogicOpEnable) {
      alignas(32) shader::Column words;
      store(words, encoded);
      apply_logic_op(target.blend.LogicOp, old[word], words);
      value = load<int32_t>(words);
    }
    write(word, (value & splat(mask)) | (load<int32_t>(old[word]) & splat(~mask)));
  });
}

// `outputs`: the pixel shader's columns; `bits`: their lanes that are written.
inline void write_targets(const DrawPlan& plan, TileColors& tile, const QuadPlaces& places,
                          const shader::Column* outputs, uint32_t bits) {
  const LivePixels live(bits);
  for (const PlannedTarget& target : plan.targets) {
    const TileTexels texels = {reinterpret_cast<QuadInMemory*>(tile.words(target.slot)),
                               target.codec->words, places};
    write_target(plan, target, texels, outputs, live);
  }
}

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
