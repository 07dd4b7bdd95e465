// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/block_format.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "runtime/shader/texture/format_codec.h"

namespace kaamos::shader {
namespace {

TEST(BlockFormat, EveryTypedBlockFormatDecodesToTexelsThatCanBeRead) {
  int count = 0;
  for (uint32_t format = 0; format < 200; ++format) {
    const BlockFormat blocks = block_format(format);
    if (blocks.codec == nullptr) continue;
    ++count;
    EXPECT_EQ(format_codec(format).bytes, 0) << format;
    EXPECT_EQ(format_codec(blocks.texel_format).bytes, blocks.codec->texel_bytes) << format;
  }
  EXPECT_EQ(count, 14);
  EXPECT_EQ(block_format(71).codec, block_format(72).codec);
  EXPECT_NE(block_format(80).codec, block_format(81).codec);
}

TEST(BlockFormat, ViewsOfBc6hHaveNoAlpha) {
  TextureView view;
  view.format = 95;
  view.swizzle[0] = 3;
  show_decoded(view);
  EXPECT_EQ(view.format, 10u);
  EXPECT_EQ(view.swizzle[0], 5);
  EXPECT_EQ(view.swizzle[1], 1);
  EXPECT_EQ(view.swizzle[3], 5);
  view = {};
  view.format = 99;
  show_decoded(view);
  EXPECT_EQ(view.format, 29u);
  EXPECT_EQ(view.swizzle[3], 3);
}

// A picture of 6 x 5 texels is 2 x 2 blocks, of which the last ones reach out of it.
TEST(BlockFormat, NothingIsWrittenOutsideOfThePictureOrOfOtherBlocks) {
  const BlockCodec& codec = *block_format(80).codec;
  uint8_t blocks[2][24] = {};
  for (int i = 0; i < 4; ++i) {
    blocks[i / 2][i % 2 * 8] = blocks[i / 2][i % 2 * 8 + 1] = static_cast<uint8_t>(i + 1);
  }
  const uint32_t size[2] = {6, 5};
  std::vector<uint16_t> texels(8 * 8, 0xABCD);
  const Rows<const uint8_t> from = {blocks[0], 24};
  const Rows<uint8_t> to = {reinterpret_cast<uint8_t*>(texels.data()), 16};
  const auto expect = [&](auto wanted) {
    for (uint32_t y = 0; y < 8; ++y) {
      for (uint32_t x = 0; x < 8; ++x) EXPECT_EQ(texels[8 * y + x], wanted(x, y)) << x << " " << y;
    }
  };
  const uint32_t last[2] = {1, 1}, one[2] = {1, 1};
  decode_blocks(codec, from, to, size, last, one);
  expect([](uint32_t x, uint32_t y) { return x / 4 == 1 && x < 6 && y == 4 ? 4 * 257 : 0xABCD; });
  const uint32_t first[2] = {0, 0}, all[2] = {2, 2};
  decode_blocks(codec, from, to, size, first, all);
  expect([](uint32_t x, uint32_t y) {
    return x < 6 && y < 5 ? static_cast<int>(1 + x / 4 + 2 * (y / 4)) * 257 : 0xABCD;
  });
}

}  // namespace
}  // namespace kaamos::shader
