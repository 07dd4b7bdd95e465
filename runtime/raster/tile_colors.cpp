// SPDX-License-Identifier: MIT
#include "runtime/raster/tile_colors.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "runtime/raster/edges.h"
#include "runtime/raster/target_codec.h"
#include "runtime/raster/tile.h"

namespace kaamos::raster {
namespace {

using Four [[gnu::vector_size(16)]] = uint32_t;
using FourInMemory [[gnu::vector_size(16), gnu::aligned(4), gnu::may_alias]] = uint32_t;

Four get(const void* from) {
  return (Four) * static_cast<const FourInMemory*>(from);
}
void put(void* to, Four value) {
  *static_cast<FourInMemory*>(to) = (FourInMemory)value;
}

// The pixels of a band that lie in the target.
struct Band {
  uint8_t* texels;
  uint64_t row_pitch;
  uint32_t columns, rows;
};

Band band_of(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice, uint32_t bytes) {
  Band band;
  band.texels =
      surface.texels + slice * surface.slice_pitch + y * surface.row_pitch + uint64_t{x} * bytes;
  band.row_pitch = surface.row_pitch;
  band.columns = std::min<uint32_t>(kTileSize, surface.width - x);
  band.rows = y < surface.height ? std::min(TileColors::kBandRows, surface.height - y) : 0;
  return band;
}

// One by one, for any size of texels and at the border of the target.
template <uint32_t kBytes, bool kLoads>
void move_texels(const Band& band, uint32_t* words) {
  constexpr uint32_t kWords = (kBytes + 3) / 4;
  for (uint32_t row = 0; row < band.rows; ++row) {
    uint8_t* texel = band.texels + row * band.row_pitch;
    for (uint32_t column = 0; column < band.columns; ++column, texel += kBytes) {
      const uint32_t quad = row / 2 * kQuadsPerRow + column / 2;
      uint32_t* lane = words + quad * kWords * 4 + (row & 1) * 2 + (column & 1);
      uint32_t values[kWords] = {};
      if constexpr (kLoads) {
        std::memcpy(values, texel, kBytes);
        for (uint32_t w = 0; w < kWords; ++w) lane[w * 4] = values[w];
      } else {
        for (uint32_t w = 0; w < kWords; ++w) values[w] = lane[w * 4];
        std::memcpy(texel, values, kBytes);
      }
    }
  }
}

// A whole band of texels of 4 or 8 bytes, quad by quad or two at a time.
template <uint32_t kBytes, bool kLoads>
void move_whole(const Band& band, uint32_t* words) {
  for (uint32_t row = 0; row < TileColors::kBandRows; row += 2) {
    uint8_t* above = band.texels + row * band.row_pitch;
    uint8_t* below = above + band.row_pitch;
    for (uint32_t byte = 0; byte < kTileSize * kBytes; byte += 16, words += 8) {
      Four a = get(kLoads ? static_cast<void*>(above + byte) : words);
      Four b = get(kLoads ? static_cast<void*>(below + byte) : words + 4);
      if constexpr (kBytes == 4) {
        // Two quads: the first two pixels of both rows, the other two.
        const Four first = __builtin_shufflevector(a, b, 0, 1, 4, 5);
        const Four second = __builtin_shufflevector(a, b, 2, 3, 6, 7);
        a = first;
        b = second;
      } else if constexpr (kLoads) {
        // A quad: the first words of its texels, the second words.
        const Four first = __builtin_shufflevector(a, b, 0, 2, 4, 6);
        const Four second = __builtin_shufflevector(a, b, 1, 3, 5, 7);
        a = first;
        b = second;
      } else {
        const Four first = __builtin_shufflevector(a, b, 0, 4, 1, 5);
        const Four second = __builtin_shufflevector(a, b, 2, 6, 3, 7);
        a = first;
        b = second;
      }
      put(kLoads ? words : static_cast<void*>(above + byte), a);
      put(kLoads ? words + 4 : static_cast<void*>(below + byte), b);
    }
  }
}

template <bool kLoads>
void move(const Band& band, uint32_t bytes, uint32_t* words) {
  const bool whole = band.columns == kTileSize && band.rows == TileColors::kBandRows;
  switch (bytes) {
    case 1:
      return move_texels<1, kLoads>(band, words);
    case 2:
      return move_texels<2, kLoads>(band, words);
    case 4:
      return whole ? move_whole<4, kLoads>(band, words) : move_texels<4, kLoads>(band, words);
    case 8:
      return whole ? move_whole<8, kLoads>(band, words) : move_texels<8, kLoads>(band, words);
    default:
      return move_texels<16, kLoads>(band, words);
  }
}

uint32_t words_of(const TargetCodec& codec, uint32_t pixels) {
  return codec.words * pixels;
}

}  // namespace

void TileColors::begin(const Targets& targets, uint32_t x, uint32_t y, uint32_t slice) {
  targets_ = &targets;
  x_ = x;
  y_ = y;
  slice_ = slice;
  bands_ = {};
  uint32_t words = 0;
  for (size_t i = 0; i < targets.color.size(); ++i) {
    first_[i] = words;
    const Surface& surface = targets.color[i];
    if (surface.texels == nullptr) continue;
    words += words_of(target_codec(surface.format), kTilePixels);
  }
  words_.resize(words);
  for (uint32_t i = 0; i < targets.color.size(); ++i) {
    if (targets.color[i].cleared) fill(i);
  }
}

void TileColors::fill(uint32_t target) {
  constexpr uint32_t kBands = kTileSize / kBandRows;
  bands_[target] = (1u << kBands) - 1;
  const Surface& surface = targets_->color[target];
  const uint32_t words = target_codec(surface.format).words;
  uint32_t* out = this->words(target);
  for (uint32_t i = 0; i < kTilePixels / 4; ++i) {
    for (uint32_t w = 0; w < words; ++w, out += 4) put(out, Four{} + surface.value[w]);
  }
}

void TileColors::load_new(uint32_t target, uint32_t bands) {
  bands_[target] |= bands;
  const Surface& surface = targets_->color[target];
  const TargetCodec& codec = target_codec(surface.format);
  for (; bands != 0; bands &= bands - 1) {
    const uint32_t row = static_cast<uint32_t>(std::countr_zero(bands)) * kBandRows;
    move<true>(band_of(surface, x_, y_ + row, slice_, codec.bytes), codec.bytes,
               words(target) + words_of(codec, row * kTileSize));
  }
}

void TileColors::store() const {
  for (size_t i = 0; i < bands_.size(); ++i) {
    const Surface& surface = targets_->color[i];
    for (uint32_t bands = bands_[i]; bands != 0; bands &= bands - 1) {
      const TargetCodec& codec = target_codec(surface.format);
      const uint32_t row = static_cast<uint32_t>(std::countr_zero(bands)) * kBandRows;
      move<false>(
          band_of(surface, x_, y_ + row, slice_, codec.bytes), codec.bytes,
          const_cast<uint32_t*>(words_.data()) + first_[i] + words_of(codec, row * kTileSize));
    }
  }
}

}  // namespace kaamos::raster
