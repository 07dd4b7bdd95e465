// SPDX-License-Identifier: MIT
//
// The subset of a block's endpoints that each texel of BC6H and BC7 takes, and the weights of the
// indices. [D3D11.3 19.5.13.4, 19.5.14.3, 19.5.14.5, 19.5.14.6]
#pragma once

#include <cstdint>

namespace kaamos::shader {

struct BlockPartition {
  uint32_t subsets = 0;  // two bits for each texel, row by row
  uint16_t anchors = 1;  // bit i: the index of texel i is stored with one bit less

  uint32_t subset(uint32_t texel) const { return subsets >> (2 * texel) & 3u; }
  uint32_t is_anchor(uint32_t texel) const { return anchors >> texel & 1u; }
};

// `subsets` is 1 to 3; index is below 64 (of two or three subsets).
BlockPartition block_partition(uint32_t subsets, uint32_t index);

// The share of the second endpoint that an index of 2, 3 or 4 bits takes, in 64ths.
inline constexpr uint8_t kBlockWeights2[4] = {0, 21, 43, 64};
inline constexpr uint8_t kBlockWeights3[8] = {0, 9, 18, 27, 37, 46, 55, 64};
inline constexpr uint8_t kBlockWeights4[16] = {0,  4,  9,  13, 17, 21, 26, 30,
                                               34, 38, 43, 47, 51, 55, 60, 64};
constexpr const uint8_t* block_weights(uint32_t index_bits) {
  return index_bits == 2 ? kBlockWeights2 : index_bits == 3 ? kBlockWeights3 : kBlockWeights4;
}

}  // namespace kaamos::shader
