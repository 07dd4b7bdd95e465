// SPDX-License-Identifier: MIT
//
// Block-compressed formats: what their blocks decode to. Shaders on the CPU read decoded texels
// (4 to 8 times the memory of the blocks, but sampled as fast as any other texture); copies
// are of the blocks.
#pragma once

#include <cstdint>

#include "kaamos/shader/texture_view.h"

namespace kaamos::shader {

inline constexpr uint32_t kBlockSide = 4;  // texels

struct BlockCodec {
  uint8_t block_bytes = 0;
  uint8_t texel_bytes = 0;                                          // of a decoded texel
  void (*decode)(const uint8_t* block, uint8_t* texels) = nullptr;  // 16 texels, row by row
};

struct BlockFormat {
  const BlockCodec* codec = nullptr;  // null: not a block-compressed format, or a typeless one
  uint32_t texel_format = 0;          // the DXGI_FORMAT of a decoded texel
  bool hides_alpha = false;           // texel_format has an alpha channel, but the format has none
};

// Formats whose blocks decode to the same bytes share a codec.
BlockFormat block_format(uint32_t dxgi_format);

// Turns a view of a block-compressed format into one of its decoded texels; leaves others alone.
void show_decoded(TextureView& view);

// Rows of blocks or of texels.
template <class Byte>
struct Rows {
  Byte* first = nullptr;
  uint64_t pitch = 0;  // bytes
};

// Decodes `count` blocks (columns, rows) from block `first` on, where `size` is that of the picture
// in texels: parts of blocks outside of it are dropped.
void decode_blocks(const BlockCodec& codec, const Rows<const uint8_t>& blocks,
                   const Rows<uint8_t>& texels, const uint32_t size[2], const uint32_t first[2],
                   const uint32_t count[2]);

}  // namespace kaamos::shader
