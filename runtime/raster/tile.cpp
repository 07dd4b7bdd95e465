// SPDX-License-Identifier: MIT
#include "runtime/raster/tile.h"

#include <algorithm>
#include <cstring>

namespace kaamos::raster {
namespace {

// Calls f(texel, number of its word) for the pixels of the tile that are in the target.
template <uint32_t kBytes, class F>
void each_texel(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice, const F& f) {
  const uint32_t columns = std::min<uint32_t>(kTileSize, surface.width - x);
  const uint32_t rows = std::min<uint32_t>(kTileSize, surface.height - y);
  for (uint32_t row = 0; row < rows; ++row) {
    uint8_t* texel = surface.texels + slice * surface.slice_pitch + (y + row) * surface.row_pitch +
                     uint64_t{x} * kBytes;
    const uint32_t word = row / 2 * kQuadsPerRow * 4 + (row & 1) * 2;
    for (uint32_t column = 0; column < columns; ++column) {
      f(texel + column * kBytes, word + column / 2 * 4 + (column & 1));
    }
  }
}

// Texels of 4 bytes, two side by side at a time, if the whole tile is in the target.
template <class Texels, class F>
bool each_pair(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice, const F& f) {
  if (x + kTileSize > surface.width || y + kTileSize > surface.height) return false;
  for (uint32_t row = 0; row < kTileSize; ++row) {
    Texels texels = surface.texels + slice * surface.slice_pitch + (y + row) * surface.row_pitch +
                    uint64_t{x} * 4;
    const uint32_t word = row / 2 * kQuadsPerRow * 4 + (row & 1) * 2;
    for (uint32_t quad = 0; quad < kQuadsPerRow; ++quad) f(texels + quad * 8, word + quad * 4);
  }
  return true;
}

// Calls f(byte of stencil, number of its pixel).
template <class F>
void each_stencil(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice, const F& f) {
  if (surface.format == rtapi::Format::kD24UnormS8Uint) {
    each_texel<4>(surface, x, y, slice, [&](uint8_t* texel, uint32_t i) { f(texel[3], i); });
  } else {
    each_texel<8>(surface, x, y, slice, [&](uint8_t* texel, uint32_t i) { f(texel[4], i); });
  }
}

}  // namespace

void TileDepth::load(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice) {
  switch (surface.format) {
    case rtapi::Format::kD16Unorm:
      each_texel<2>(surface, x, y, slice, [&](const uint8_t* texel, uint32_t word) {
        uint16_t value;
        std::memcpy(&value, texel, 2);
        words[word] = value;
      });
      break;
    case rtapi::Format::kD32FloatS8X24Uint:
      each_texel<8>(surface, x, y, slice, [&](const uint8_t* texel, uint32_t word) {
        std::memcpy(&words[word], texel, 4);
      });
      break;
    default:
      if (each_pair<const uint8_t*>(surface, x, y, slice, [&](const uint8_t* pair, uint32_t word) {
            std::memcpy(&words[word], pair, 8);
          })) {
        break;
      }
      each_texel<4>(surface, x, y, slice, [&](const uint8_t* texel, uint32_t word) {
        std::memcpy(&words[word], texel, 4);
      });
  }
}

void TileDepth::store(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice) const {
  switch (surface.format) {
    case rtapi::Format::kD16Unorm:
      each_texel<2>(surface, x, y, slice, [&](uint8_t* texel, uint32_t word) {
        const auto value = static_cast<uint16_t>(words[word]);
        std::memcpy(texel, &value, 2);
      });
      break;
    case rtapi::Format::kD32FloatS8X24Uint:
      each_texel<8>(surface, x, y, slice,
                    [&](uint8_t* texel, uint32_t word) { std::memcpy(texel, &words[word], 4); });
      break;
    default:
      if (each_pair<uint8_t*>(surface, x, y, slice, [&](uint8_t* pair, uint32_t word) {
            std::memcpy(pair, &words[word], 8);
          })) {
        break;
      }
      each_texel<4>(surface, x, y, slice,
                    [&](uint8_t* texel, uint32_t word) { std::memcpy(texel, &words[word], 4); });
  }
}

void TileStencil::load(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice) {
  each_stencil(surface, x, y, slice, [&](uint8_t texel, uint32_t i) { bytes[i] = texel; });
}

void TileStencil::store(const Surface& surface, uint32_t x, uint32_t y, uint32_t slice) const {
  each_stencil(surface, x, y, slice, [&](uint8_t& texel, uint32_t i) { texel = bytes[i]; });
}

}  // namespace kaamos::raster
