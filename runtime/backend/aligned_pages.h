// SPDX-License-Identifier: MIT
//
// Pages of this process at addresses that buffers may have.
#pragma once

#include <cstdint>

namespace kaamos::runtime {

// Addresses of buffers are multiples of it, in bytes, as in D3D12.
inline constexpr uint64_t kBufferAlignment = 64 * 1024;

inline constexpr uint64_t round_up(uint64_t bytes, uint64_t to) {
  return (bytes + to - 1) / to * to;
}

// Private pages of zeros, which cost nothing until they are touched, at a multiple of
// kBufferAlignment. `protection`: as of mmap(2). Null if there is no room. munmap frees them.
uint8_t* map_aligned(uint64_t bytes, int protection);

}  // namespace kaamos::runtime
