// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/bc1_to_bc5.h"

#include <cstring>

namespace kaamos::shader {
namespace {

template <class T>
T read(const uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

// A colour of R5G6B5 as bytes: the highest bits are repeated below.
void widen(uint32_t stored, uint8_t colour[4]) {
  const uint32_t red = stored >> 11, green = stored >> 5 & 0x3F, blue = stored & 0x1F;
  colour[0] = static_cast<uint8_t>(red << 3 | red >> 2);
  colour[1] = static_cast<uint8_t>(green << 2 | green >> 4);
  colour[2] = static_cast<uint8_t>(blue << 3 | blue >> 2);
  colour[3] = 255;
}

// Two colours and two between them; or, if allowed and the first is not the larger one, one between
// them and transparent black.
void decode_colours(const uint8_t* block, bool may_be_transparent, uint8_t* texels) {
  const auto first = read<uint16_t>(block), second = read<uint16_t>(block + 2);
  uint8_t palette[4][4] = {};
  widen(first, palette[0]);
  widen(second, palette[1]);
  const bool four = first > second || !may_be_transparent;
  for (int i = 0; i < 3; ++i) {
    const uint32_t a = palette[0][i], b = palette[1][i];
    palette[2][i] = static_cast<uint8_t>(four ? (2 * a + b) / 3 : (a + b) / 2);
    palette[3][i] = static_cast<uint8_t>(four ? (a + 2 * b) / 3 : 0);
  }
  palette[2][3] = 255;
  palette[3][3] = four ? 255 : 0;
  auto indices = read<uint32_t>(block + 4);
  for (int i = 0; i < 16; ++i, indices >>= 2) std::memcpy(texels + 4 * i, palette[indices & 3], 4);
}

// Reads which value of a palette of eight each of 16 texels takes.
void take_indices(const uint8_t* block, uint8_t indices[16]) {
  uint64_t bits = read<uint64_t>(block) >> 16;
  for (int i = 0; i < 16; ++i, bits >>= 3) indices[i] = bits & 7;
}

// The values of a palette: the two that are stored, and six or four between them, which are
// `between(numerator, denominator)`.
template <class T, class Stored, class Between>
void fill_palette(T palette[8], Stored first, Stored second, T low, T high, Between between) {
  palette[0] = between(first, 1);
  palette[1] = between(second, 1);
  const int steps = first > second ? 7 : 5;
  for (int i = 1; i < steps; ++i) {
    palette[i + 1] = between((steps - i) * first + i * second, steps);
  }
  if (steps == 7) return;
  palette[6] = low;
  palette[7] = high;
}

// A block of BC4, to the first of `stride` values for each texel.
template <class T>
void decode_channel(const uint8_t* block, const T palette[8], T* values, int stride) {
  uint8_t indices[16];
  take_indices(block, indices);
  for (int i = 0; i < 16; ++i) values[i * stride] = palette[indices[i]];
}

// Rounded to nearest.
void decode_bytes(const uint8_t* block, uint8_t* values, int stride) {
  uint8_t palette[8];
  fill_palette<uint8_t, int>(palette, block[0], block[1], 0, 255, [](int sum, int steps) {
    return static_cast<uint8_t>((2 * sum + steps) / (2 * steps));
  });
  decode_channel(block, palette, values, stride);
}
void decode_unorm(const uint8_t* block, uint16_t* values, int stride) {
  uint16_t palette[8];
  fill_palette<uint16_t, int>(palette, block[0], block[1], 0, 65535, [](int sum, int steps) {
    return static_cast<uint16_t>((2 * 257 * sum + steps) / (2 * steps));
  });
  decode_channel(block, palette, values, stride);
}
// -128 is -1, like -127, but is the smaller of the two where they are compared.
void decode_snorm(const uint8_t* block, float* values, int stride) {
  const auto first = static_cast<int8_t>(block[0]), second = static_cast<int8_t>(block[1]);
  const auto clamped = [](int value) { return value < -127 ? -127 : value; };
  const int a = clamped(first), b = clamped(second);
  const auto between = [](int sum, int steps) {
    return static_cast<float>(sum) / static_cast<float>(127 * steps);
  };
  float palette[8] = {};
  fill_palette<float, int>(palette, a, b, -1.0f, 1.0f, between);
  if (a == b && first > second) palette[6] = palette[7] = -1.0f;
  decode_channel(block, palette, values, stride);
}

}  // namespace

void decode_bc1(const uint8_t* block, uint8_t* texels) {
  decode_colours(block, true, texels);
}

void decode_bc2(const uint8_t* block, uint8_t* texels) {
  decode_colours(block + 8, false, texels);
  auto alphas = read<uint64_t>(block);
  for (int i = 0; i < 16; ++i, alphas >>= 4) {
    texels[4 * i + 3] = static_cast<uint8_t>((alphas & 15) * 17);
  }
}

void decode_bc3(const uint8_t* block, uint8_t* texels) {
  decode_colours(block + 8, false, texels);
  decode_bytes(block, texels + 3, 4);
}

void decode_bc4_unorm(const uint8_t* block, uint8_t* texels) {
  uint16_t values[16];
  decode_unorm(block, values, 1);
  std::memcpy(texels, values, sizeof values);
}

void decode_bc5_unorm(const uint8_t* block, uint8_t* texels) {
  uint16_t values[32];
  decode_unorm(block, values, 2);
  decode_unorm(block + 8, values + 1, 2);
  std::memcpy(texels, values, sizeof values);
}

void decode_bc4_snorm(const uint8_t* block, uint8_t* texels) {
  float values[16];
  decode_snorm(block, values, 1);
  std::memcpy(texels, values, sizeof values);
}

void decode_bc5_snorm(const uint8_t* block, uint8_t* texels) {
  float values[32];
  decode_snorm(block, values, 2);
  decode_snorm(block + 8, values + 1, 2);
  std::memcpy(texels, values, sizeof values);
}

}  // namespace kaamos::shader
