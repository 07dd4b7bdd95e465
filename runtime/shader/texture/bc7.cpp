// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/bc7.h"

#include <bit>
#include <cstring>
#include <utility>

#include "runtime/shader/texture/block_bits.h"
#include "runtime/shader/texture/block_partitions.h"

namespace kaamos::shader {
namespace {

// The number of bits of each part of a block.
struct Mode {
  uint8_t subsets;
  uint8_t partition;
  uint8_t rotation;
  uint8_t selector;
  uint8_t colour;  // of one channel of an endpoint
  uint8_t alpha;
  bool endpoint_bits;  // each endpoint has one more bit, the lowest of all its channels
  bool subset_bits;    // the endpoints of a subset share it
  uint8_t index;
  uint8_t second_index;  // modes with separate alpha
};
constexpr Mode kModes[8] = {
    {3, 4, 0, 0, 4, 0, true, false, 3, 0},  {2, 6, 0, 0, 6, 0, false, true, 3, 0},
    {3, 6, 0, 0, 5, 0, false, false, 2, 0}, {2, 6, 0, 0, 7, 0, true, false, 2, 0},
    {1, 0, 2, 1, 5, 6, false, false, 2, 3}, {1, 0, 2, 0, 7, 8, false, false, 2, 2},
    {1, 0, 0, 0, 7, 7, true, false, 4, 0},  {2, 6, 0, 0, 5, 5, true, false, 2, 0},
};

// Fills 8 bits by repeating the highest ones.
uint8_t widened(uint32_t value, uint32_t bits) {
  const uint32_t top = value << (8 - bits);
  return static_cast<uint8_t>(top | top >> bits);
}

using Endpoints = uint8_t[6][4];

void take_endpoints(BlockBits& bits, const Mode& mode, Endpoints& endpoints) {
  const uint32_t count = 2u * mode.subsets;
  const bool has_low_bits = mode.endpoint_bits || mode.subset_bits;
  uint32_t stored[6][4] = {};
  for (uint32_t channel = 0; channel < 4; ++channel) {
    const uint32_t width = channel == 3 ? mode.alpha : mode.colour;
    for (uint32_t i = 0; i < count; ++i) stored[i][channel] = bits.take(width);
  }
  uint32_t low[6] = {};
  for (uint32_t i = 0; has_low_bits && i < count; ++i) {
    low[i] = mode.subset_bits && i % 2 == 1 ? low[i - 1] : bits.take(1);
  }
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t channel = 0; channel < 4; ++channel) {
      const uint32_t width = channel == 3 ? mode.alpha : mode.colour;
      endpoints[i][channel] = width == 0     ? uint8_t{255}
                              : has_low_bits ? widened(stored[i][channel] << 1 | low[i], width + 1)
                                             : widened(stored[i][channel], width);
    }
  }
}

uint8_t between(uint32_t first, uint32_t second, uint32_t weight) {
  return static_cast<uint8_t>(((64 - weight) * first + weight * second + 32) >> 6);
}

}  // namespace

void decode_bc7(const uint8_t* block, uint8_t* texels) {
  if (block[0] == 0) {
    std::memset(texels, 0, 64);
    return;
  }
  BlockBits bits(block);
  const auto number = static_cast<uint32_t>(std::countr_zero(block[0]));
  bits.take(number + 1);
  const Mode& mode = kModes[number];
  const BlockPartition partition = block_partition(mode.subsets, bits.take(mode.partition));
  const uint32_t rotation = bits.take(mode.rotation);
  const bool alpha_is_first = bits.take(mode.selector) != 0;
  Endpoints endpoints;
  take_endpoints(bits, mode, endpoints);
  uint8_t first[16];
  for (uint32_t i = 0; i < 16; ++i) {
    first[i] = block_weights(mode.index)[bits.take(mode.index - partition.is_anchor(i))];
  }
  uint8_t second[16];
  for (uint32_t i = 0; mode.second_index != 0 && i < 16; ++i) {
    second[i] = block_weights(mode.second_index)[bits.take(mode.second_index - (i == 0 ? 1u : 0u))];
  }
  const uint8_t* colour = alpha_is_first ? second : first;
  const uint8_t* alpha = mode.second_index == 0 || alpha_is_first ? first : second;
  for (uint32_t i = 0; i < 16; ++i, texels += 4) {
    const uint8_t* from = endpoints[2 * partition.subset(i)];
    const uint8_t* to = endpoints[2 * partition.subset(i) + 1];
    for (int channel = 0; channel < 3; ++channel) {
      texels[channel] = between(from[channel], to[channel], colour[i]);
    }
    texels[3] = between(from[3], to[3], alpha[i]);
    if (rotation != 0) std::swap(texels[3], texels[rotation - 1]);
  }
}

}  // namespace kaamos::shader
