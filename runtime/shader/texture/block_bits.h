// SPDX-License-Identifier: MIT
//
// The 128 bits of a block of BC6H or BC7, read from the lowest on.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace kaamos::shader {

static_assert(std::endian::native == std::endian::little, "blocks are stored low byte first");

class BlockBits {
 public:
  explicit BlockBits(const uint8_t block[16]) {
    std::memcpy(&low_, block, 8);
    std::memcpy(&high_, block + 8, 8);
  }
  // The next `count` bits, at most 32.
  uint32_t take(uint32_t count) {
    if (count == 0) return 0;
    const auto value = static_cast<uint32_t>(low_ & ((uint64_t{1} << count) - 1));
    low_ = low_ >> count | high_ << (64 - count);
    high_ >>= count;
    return value;
  }

 private:
  uint64_t low_ = 0;
  uint64_t high_ = 0;
};

}  // namespace kaamos::shader
