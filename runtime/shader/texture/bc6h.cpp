// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/bc6h.h"

#include <array>
#include <cstring>

#include "runtime/shader/texture/block_bits.h"
#include "runtime/shader/texture/block_partitions.h"

namespace kaamos::shader {
namespace {

constexpr uint16_t kOne = 0x3C00;  // as a half float

// Bits of one endpoint's channel that lie together in a block.
struct Run {
  uint8_t channel = 0;
  uint8_t endpoint = 0;  // 0 and 1 of the first subset, 2 and 3 of the second
  uint8_t first = 0;     // lowest bit
  uint8_t count = 0;     // 0: the end
};
using Layout = std::array<Run, 25>;

// Parses what follows the mode's bits, lowest first. "bz4" is bit 4 of endpoint z's blue, "rw:10"
// its ten lowest bits; endpoints are called w, x, y and z. [D3D11.3 table 2 of 19.5.13.5]
constexpr Layout layout_of(const char* text) {
  Layout layout = {};
  for (size_t i = 0; *text != '\0'; ++i) {
    const auto number = [&text] {
      uint8_t n = 0;
      for (; *text >= '0' && *text <= '9'; ++text) n = static_cast<uint8_t>(n * 10 + *text - '0');
      return n;
    };
    Run& run = layout[i];
    run.channel = *text == 'r' ? 0 : *text == 'g' ? 1 : 2;
    run.endpoint = static_cast<uint8_t>(text[1] - 'w');
    text += 2;
    if (*text == ':') {
      ++text;
      run.count = number();
    } else {
      run.first = number();
      run.count = 1;
    }
    if (*text == ' ') ++text;
  }
  return layout;
}

struct Mode {
  uint8_t subsets;
  bool is_relative;   // endpoints x, y and z are differences from w
  uint8_t precision;  // bits of endpoint w
  uint8_t others[3];  // bits of the others: red, green, blue
  Layout layout;
};
constexpr Mode kModes[14] = {
    {2,
     true,
     10,
     {5, 5, 5},
     layout_of("gy4 by4 bz4 rw:10 gw:10 bw:10 rx:5 gz4 gy:4 gx:5 bz0 gz:4 bx:5 bz1 by:4 ry:5 bz2 "
               "rz:5 bz3")},
    {2,
     true,
     7,
     {6, 6, 6},
     layout_of("gy5 gz4 gz5 rw:7 bz0 bz1 by4 gw:7 by5 bz2 gy4 bw:7 bz3 bz5 bz4 rx:6 gy:4 gx:6 gz:4 "
               "bx:6 by:4 ry:6 rz:6")},
    {2,
     true,
     11,
     {5, 4, 4},
     layout_of("rw:10 gw:10 bw:10 rx:5 rw10 gy:4 gx:4 gw10 bz0 gz:4 bx:4 bw10 bz1 by:4 ry:5 bz2 "
               "rz:5 bz3")},
    {2,
     true,
     11,
     {4, 5, 4},
     layout_of("rw:10 gw:10 bw:10 rx:4 rw10 gz4 gy:4 gx:5 gw10 gz:4 bx:4 bw10 bz1 by:4 ry:4 bz0 "
               "bz2 rz:4 gy4 bz3")},
    {2,
     true,
     11,
     {4, 4, 5},
     layout_of("rw:10 gw:10 bw:10 rx:4 rw10 by4 gy:4 gx:4 gw10 bz0 gz:4 bx:5 bw10 by:4 ry:4 bz1 "
               "bz2 rz:4 bz4 bz3")},
    {2,
     true,
     9,
     {5, 5, 5},
     layout_of("rw:9 by4 gw:9 gy4 bw:9 bz4 rx:5 gz4 gy:4 gx:5 bz0 gz:4 bx:5 bz1 by:4 ry:5 bz2 rz:5 "
               "bz3")},
    {2,
     true,
     8,
     {6, 5, 5},
     layout_of("rw:8 gz4 by4 gw:8 bz2 gy4 bw:8 bz3 bz4 rx:6 gy:4 gx:5 bz0 gz:4 bx:5 bz1 by:4 ry:6 "
               "rz:6")},
    {2,
     true,
     8,
     {5, 6, 5},
     layout_of("rw:8 bz0 by4 gw:8 gy5 gy4 bw:8 gz5 bz4 rx:5 gz4 gy:4 gx:6 gz:4 bx:5 bz1 by:4 ry:5 "
               "bz2 rz:5 bz3")},
    {2,
     true,
     8,
     {5, 5, 6},
     layout_of("rw:8 bz1 by4 gw:8 by5 gy4 bw:8 bz5 bz4 rx:5 gz4 gy:4 gx:5 bz0 gz:4 bx:6 by:4 ry:5 "
               "bz2 rz:5 bz3")},
    {2,
     false,
     6,
     {6, 6, 6},
     layout_of("rw:6 gz4 bz0 bz1 by4 gw:6 gy5 by5 bz2 gy4 bw:6 gz5 bz3 bz5 bz4 rx:6 gy:4 gx:6 gz:4 "
               "bx:6 by:4 ry:6 rz:6")},
    {1, false, 10, {10, 10, 10}, layout_of("rw:10 gw:10 bw:10 rx:10 gx:10 bx:10")},
    {1, true, 11, {9, 9, 9}, layout_of("rw:10 gw:10 bw:10 rx:9 rw10 gx:9 gw10 bx:9 bw10")},
    {1,
     true,
     12,
     {8, 8, 8},
     layout_of("rw:10 gw:10 bw:10 rx:8 rw11 rw10 gx:8 gw11 gw10 bx:8 bw11 bw10")},
    {1,
     true,
     16,
     {4, 4, 4},
     layout_of("rw:10 gw:10 bw:10 rx:4 rw15 rw14 rw13 rw12 rw11 rw10 gx:4 gw15 gw14 gw13 gw12 gw11 "
               "gw10 bx:4 bw15 bw14 bw13 bw12 bw11 bw10")},
};

// Null if the mode is reserved.
const Mode* take_mode(BlockBits& bits) {
  const uint32_t low = bits.take(2);
  if (low < 2) return &kModes[low];
  const uint32_t high = bits.take(3);
  if (low == 2) return &kModes[2 + high];
  return high < 4 ? &kModes[10 + high] : nullptr;
}

int32_t sign_extended(uint32_t value, uint32_t bits) {
  return static_cast<int32_t>(value << (32 - bits)) >> (32 - bits);
}

using Endpoints = int32_t[4][3];

void take_endpoints(BlockBits& bits, const Mode& mode, bool is_signed, Endpoints& endpoints) {
  uint32_t stored[4][3] = {};
  for (const Run* run = mode.layout.data(); run->count != 0; ++run) {
    stored[run->endpoint][run->channel] |= bits.take(run->count) << run->first;
  }
  const uint32_t mask = (1u << mode.precision) - 1;
  for (int channel = 0; channel < 3; ++channel) {
    const uint32_t base = stored[0][channel];
    endpoints[0][channel] =
        is_signed ? sign_extended(base, mode.precision) : static_cast<int32_t>(base);
    for (int i = 1; i < 2 * mode.subsets; ++i) {
      const uint32_t other = stored[i][channel];
      const uint32_t width = mode.others[channel];
      const uint32_t value =
          mode.is_relative ? (base + static_cast<uint32_t>(sign_extended(other, width))) & mask
                           : other;
      endpoints[i][channel] =
          is_signed ? sign_extended(value, mode.precision) : static_cast<int32_t>(value);
    }
  }
}

// To 16 bits, of which one is the sign in the signed format.
int32_t unquantized(int32_t value, uint32_t precision, bool is_signed) {
  if (!is_signed) {
    if (precision >= 15 || value == 0) return value;
    if (value == (1 << precision) - 1) return 0xFFFF;
    return ((value << 16) + 0x8000) >> precision;
  }
  if (precision >= 16 || value == 0) return value;
  const int32_t magnitude = value < 0 ? -value : value;
  const int32_t wide = magnitude >= (1 << (precision - 1)) - 1
                           ? 0x7FFF
                           : ((magnitude << 15) + 0x4000) >> (precision - 1);
  return value < 0 ? -wide : wide;
}

uint16_t finished(int32_t value, bool is_signed) {
  if (!is_signed) return static_cast<uint16_t>(value * 31 >> 6);
  const int32_t magnitude = (value < 0 ? -value : value) * 31 >> 5;
  // A negative value too small for a half float is zero, not minus zero.
  return static_cast<uint16_t>(value < 0 && magnitude != 0 ? 0x8000 | magnitude : magnitude);
}

void decode(const uint8_t* block, uint8_t* texels, bool is_signed) {
  uint16_t texel[4] = {0, 0, 0, kOne};
  BlockBits bits(block);
  const Mode* mode = take_mode(bits);
  if (mode == nullptr) {
    for (int i = 0; i < 16; ++i) std::memcpy(texels + 8 * i, texel, 8);
    return;
  }
  Endpoints endpoints;
  take_endpoints(bits, *mode, is_signed, endpoints);
  for (int i = 0; i < 2 * mode->subsets; ++i) {
    for (int32_t& channel : endpoints[i])
      channel = unquantized(channel, mode->precision, is_signed);
  }
  const BlockPartition partition =
      block_partition(mode->subsets, bits.take(mode->subsets == 2 ? 5 : 0));
  const uint32_t index_bits = mode->subsets == 2 ? 3 : 4;
  for (uint32_t i = 0; i < 16; ++i) {
    const int32_t weight =
        block_weights(index_bits)[bits.take(index_bits - partition.is_anchor(i))];
    const int32_t* from = endpoints[2 * partition.subset(i)];
    const int32_t* to = endpoints[2 * partition.subset(i) + 1];
    for (int channel = 0; channel < 3; ++channel) {
      texel[channel] =
          finished((from[channel] * (64 - weight) + to[channel] * weight + 32) >> 6, is_signed);
    }
    std::memcpy(texels + 8 * i, texel, 8);
  }
}

}  // namespace

void decode_bc6h_unsigned(const uint8_t* block, uint8_t* texels) {
  decode(block, texels, false);
}
void decode_bc6h_signed(const uint8_t* block, uint8_t* texels) {
  decode(block, texels, true);
}

}  // namespace kaamos::shader
