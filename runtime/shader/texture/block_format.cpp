// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/block_format.h"

#include <algorithm>
#include <cstring>

#include "runtime/shader/texture/bc1_to_bc5.h"
#include "runtime/shader/texture/bc6h.h"
#include "runtime/shader/texture/bc7.h"

namespace kaamos::shader {
namespace {

constexpr BlockCodec kBc1 = {8, 4, decode_bc1};
constexpr BlockCodec kBc2 = {16, 4, decode_bc2};
constexpr BlockCodec kBc3 = {16, 4, decode_bc3};
constexpr BlockCodec kBc4Unorm = {8, 2, decode_bc4_unorm};
constexpr BlockCodec kBc4Snorm = {8, 4, decode_bc4_snorm};
constexpr BlockCodec kBc5Unorm = {16, 4, decode_bc5_unorm};
constexpr BlockCodec kBc5Snorm = {16, 8, decode_bc5_snorm};
constexpr BlockCodec kBc6hUnsigned = {16, 8, decode_bc6h_unsigned};
constexpr BlockCodec kBc6hSigned = {16, 8, decode_bc6h_signed};
constexpr BlockCodec kBc7 = {16, 4, decode_bc7};

// DXGI_FORMATs of decoded texels.
constexpr uint32_t kR16G16B16A16Float = 10, kR32G32Float = 16, kR8G8B8A8Unorm = 28,
                   kR8G8B8A8UnormSrgb = 29, kR16G16Unorm = 35, kR32Float = 41, kR16Unorm = 56;

}  // namespace

BlockFormat block_format(uint32_t dxgi_format) {
  switch (dxgi_format) {
    case 71:
      return {&kBc1, kR8G8B8A8Unorm};
    case 72:
      return {&kBc1, kR8G8B8A8UnormSrgb};
    case 74:
      return {&kBc2, kR8G8B8A8Unorm};
    case 75:
      return {&kBc2, kR8G8B8A8UnormSrgb};
    case 77:
      return {&kBc3, kR8G8B8A8Unorm};
    case 78:
      return {&kBc3, kR8G8B8A8UnormSrgb};
    case 80:
      return {&kBc4Unorm, kR16Unorm};
    case 81:
      return {&kBc4Snorm, kR32Float};
    case 83:
      return {&kBc5Unorm, kR16G16Unorm};
    case 84:
      return {&kBc5Snorm, kR32G32Float};
    case 95:
      return {&kBc6hUnsigned, kR16G16B16A16Float, true};
    case 96:
      return {&kBc6hSigned, kR16G16B16A16Float, true};
    case 98:
      return {&kBc7, kR8G8B8A8Unorm};
    case 99:
      return {&kBc7, kR8G8B8A8UnormSrgb};
    default:
      return {};
  }
}

void show_decoded(TextureView& view) {
  const BlockFormat format = block_format(view.format);
  if (format.codec == nullptr) return;
  view.format = format.texel_format;
  if (!format.hides_alpha) return;
  for (uint8_t& channel : view.swizzle) {
    if (channel == 3) channel = 5;
  }
}

void decode_blocks(const BlockCodec& codec, const Rows<const uint8_t>& blocks,
                   const Rows<uint8_t>& texels, const uint32_t size[2], const uint32_t first[2],
                   const uint32_t count[2]) {
  constexpr uint32_t kLargestTexel = 8;
  uint8_t decoded[kBlockSide * kBlockSide * kLargestTexel];
  const uint32_t row_bytes = kBlockSide * codec.texel_bytes;
  for (uint32_t row = first[1]; row < first[1] + count[1]; ++row) {
    const uint8_t* block =
        blocks.first + row * blocks.pitch + uint64_t{first[0]} * codec.block_bytes;
    const uint32_t y = row * kBlockSide;
    if (y >= size[1]) return;
    const uint32_t height = std::min(kBlockSide, size[1] - y);
    for (uint32_t column = first[0]; column < first[0] + count[0]; ++column) {
      const uint32_t x = column * kBlockSide;
      if (x >= size[0]) break;
      codec.decode(block, decoded);
      block += codec.block_bytes;
      const uint32_t width = std::min(kBlockSide, size[0] - x);
      uint8_t* out = texels.first + y * texels.pitch + uint64_t{x} * codec.texel_bytes;
      for (uint32_t i = 0; i < height; ++i, out += texels.pitch) {
        std::memcpy(out, decoded + i * row_bytes, size_t{width} * codec.texel_bytes);
      }
    }
  }
}

}  // namespace kaamos::shader
