// SPDX-License-Identifier: MIT
#include "runtime/backend/aligned_pages.h"

#include <sys/mman.h>

namespace kaamos::runtime {

uint8_t* map_aligned(uint64_t bytes, int protection) {
  void* mapped = mmap(nullptr, bytes + kBufferAlignment, protection,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  auto* start = static_cast<uint8_t*>(mapped);
  const uint64_t before = -reinterpret_cast<uint64_t>(start) % kBufferAlignment;
  if (before != 0) munmap(start, before);
  munmap(start + before + bytes, kBufferAlignment - before);
  return start + before;
}

}  // namespace kaamos::runtime
