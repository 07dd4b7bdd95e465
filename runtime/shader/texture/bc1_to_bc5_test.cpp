// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/bc1_to_bc5.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace kaamos::shader {
namespace {

using Bytes4 = std::array<uint8_t, 4>;
using Decode = void (*)(const uint8_t* block, uint8_t* texels);

template <class Texel, size_t N>
std::array<Texel, 16> decoded(Decode decode, const std::array<uint8_t, N>& block) {
  std::array<Texel, 16> texels;
  std::memset(texels.data(), 0xCD, sizeof texels);
  decode(block.data(), reinterpret_cast<uint8_t*>(texels.data()));
  return texels;
}

// 0xE4: texels 0 to 3 of a row take colours 0 to 3.
constexpr uint8_t kCount = 0xE4;

TEST(Bc1, AFirstColourThatIsLargerMakesFourColours) {
  // Red 31, green 0, blue 9 and red 0, green 63, blue 4: bytes 255, 0, 74 and 0, 255, 33.
  const std::array<uint8_t, 8> block = {0x09, 0xF8, 0xE4, 0x07, kCount, 0, 0, 0xFF};
  const auto texels = decoded<Bytes4>(decode_bc1, block);
  EXPECT_EQ(texels[0], (Bytes4{255, 0, 74, 255}));
  EXPECT_EQ(texels[1], (Bytes4{0, 255, 33, 255}));
  EXPECT_EQ(texels[2], (Bytes4{170, 85, 60, 255}));  // (2 * 74 + 33) / 3, no fraction
  EXPECT_EQ(texels[3], (Bytes4{85, 170, 46, 255}));
  EXPECT_EQ(texels[4], texels[0]);
  EXPECT_EQ(texels[15], texels[3]);
}

TEST(Bc1, OtherwiseTheFourthIsTransparentBlack) {
  const std::array<uint8_t, 8> block = {0xE4, 0x07, 0x09, 0xF8, kCount, 0, 0, 0};
  const auto texels = decoded<Bytes4>(decode_bc1, block);
  EXPECT_EQ(texels[0], (Bytes4{0, 255, 33, 255}));
  EXPECT_EQ(texels[1], (Bytes4{255, 0, 74, 255}));
  EXPECT_EQ(texels[2], (Bytes4{127, 127, 53, 255}));
  EXPECT_EQ(texels[3], (Bytes4{0, 0, 0, 0}));
  const std::array<uint8_t, 8> equal = {0xFF, 0xFF, 0xFF, 0xFF, kCount, 0, 0, 0};
  EXPECT_EQ(decoded<Bytes4>(decode_bc1, equal)[3], (Bytes4{0, 0, 0, 0}));
}

TEST(Bc2, HasFourColoursInAnyOrderAndAlphaOfFourBits) {
  const std::array<uint8_t, 16> block = {0x10, 0x32, 0x54, 0x76, 0x98,   0xBA,   0xDC, 0xFE,
                                         0xE4, 0x07, 0x09, 0xF8, kCount, kCount, 0,    0};
  const auto texels = decoded<Bytes4>(decode_bc2, block);
  for (int i = 0; i < 16; ++i) EXPECT_EQ(texels[i][3], 17 * i);
  EXPECT_EQ(texels[2], (Bytes4{85, 170, 46, 2 * 17}));
  EXPECT_EQ(texels[7], (Bytes4{170, 85, 60, 7 * 17}));
}

// Indices 0 to 7, twice.
constexpr uint8_t kIndices[6] = {0x88, 0xC6, 0xFA, 0x88, 0xC6, 0xFA};

std::array<uint8_t, 8> channel(uint8_t first, uint8_t second) {
  std::array<uint8_t, 8> block = {first, second};
  std::memcpy(&block[2], kIndices, 6);
  return block;
}

TEST(Bc3, HasAlphaOfEightValues) {
  std::array<uint8_t, 16> block = {};
  const auto eight = channel(250, 40), six = channel(40, 250);
  std::memcpy(block.data(), eight.data(), 8);
  const std::array<uint8_t, 8> falling = {250, 40, 220, 190, 160, 130, 100, 70};
  auto texels = decoded<Bytes4>(decode_bc3, block);
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i], (Bytes4{0, 0, 0, falling[i % 8]}));
  std::memcpy(block.data(), six.data(), 8);
  const std::array<uint8_t, 8> rising = {40, 250, 82, 124, 166, 208, 0, 255};
  texels = decoded<Bytes4>(decode_bc3, block);
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i][3], rising[i % 8]);
}

TEST(Bc4, UnormHas16Bits) {
  // 257 of 65535 is 1 of 255. Sevenths of 257: 36.7, 73.4, 110.1, 146.9, 183.6, 220.3.
  const std::array<uint16_t, 8> falling = {257, 0, 220, 184, 147, 110, 73, 37};
  auto texels = decoded<uint16_t>(decode_bc4_unorm, channel(1, 0));
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i], falling[i % 8]) << i;
  const std::array<uint16_t, 8> rising = {0, 257, 51, 103, 154, 206, 0, 65535};
  texels = decoded<uint16_t>(decode_bc4_unorm, channel(0, 1));
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i], rising[i % 8]) << i;
}

TEST(Bc4, SnormIsExact) {
  const auto of = [](int numerator, int denominator) {
    return static_cast<float>(numerator) / static_cast<float>(denominator);
  };
  const std::array<float, 8> falling = {of(127, 127), of(-127, 127), of(5, 7),  of(3, 7),
                                        of(1, 7),     of(-1, 7),     of(-3, 7), of(-5, 7)};
  auto texels = decoded<float>(decode_bc4_snorm, channel(127, 0x81));
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i], falling[i % 8]) << i;
  // -3 and 2 of 127.
  const std::array<float, 8> rising = {of(-3, 127), of(2, 127), of(-2, 127), of(-1, 127),
                                       0.0f,        of(1, 127), -1.0f,       1.0f};
  texels = decoded<float>(decode_bc4_snorm, channel(0xFD, 2));
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i], rising[i % 8]) << i;
}

// -128 and -127 both are -1. Which of the two is larger still decides what index 7 means.
TEST(Bc4, SnormTakesMinus128AsMinusOne) {
  auto texels = decoded<float>(decode_bc4_snorm, channel(0x80, 0x81));
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i], i % 8 == 7 ? 1.0f : -1.0f) << i;
  texels = decoded<float>(decode_bc4_snorm, channel(0x81, 0x80));
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i], -1.0f) << i;
}

TEST(Bc5, HasTwoChannelsOfBc4) {
  const auto first = channel(200, 10), second = channel(30, 90);
  std::array<uint8_t, 16> block;
  std::memcpy(block.data(), first.data(), 8);
  std::memcpy(block.data() + 8, second.data(), 8);
  const auto red = decoded<uint16_t>(decode_bc4_unorm, first);
  const auto green = decoded<uint16_t>(decode_bc4_unorm, second);
  const auto both = decoded<std::array<uint16_t, 2>>(decode_bc5_unorm, block);
  const auto signed_red = decoded<float>(decode_bc4_snorm, first);
  const auto signed_green = decoded<float>(decode_bc4_snorm, second);
  const auto signed_both = decoded<std::array<float, 2>>(decode_bc5_snorm, block);
  for (size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(both[i], (std::array{red[i], green[i]})) << i;
    EXPECT_EQ(signed_both[i], (std::array{signed_red[i], signed_green[i]})) << i;
  }
}

}  // namespace
}  // namespace kaamos::shader
