// SPDX-License-Identifier: MIT
#include "runtime/embree/memory.h"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>

#include "runtime/backend/aligned_pages.h"

namespace kaamos::embree {
namespace {

constexpr uint64_t kMapped = 1024 * 1024;  // from here on, pages come straight from the system

uint64_t rounded(uint64_t bytes) {
  return runtime::round_up(bytes, runtime::kBufferAlignment);
}

}  // namespace

uint8_t* Memory::allocate(uint64_t size_bytes) {
  const uint64_t bytes = rounded(size_bytes);
  if (bytes < kMapped) {
    void* block = std::aligned_alloc(runtime::kBufferAlignment, bytes);
    if (block != nullptr) std::memset(block, 0, bytes);
    return static_cast<uint8_t*>(block);
  }
  return runtime::map_aligned(bytes, PROT_READ | PROT_WRITE);
}

void Memory::release(uint8_t* block, uint64_t size_bytes) {
  const uint64_t bytes = rounded(size_bytes);
  if (bytes < kMapped) {
    std::free(block);
  } else {
    munmap(block, bytes);
  }
}

std::shared_ptr<const TopLevel> Memory::find_top_level(uint64_t address) const {
  const auto structure = find(address);
  return structure ? std::static_pointer_cast<const TopLevel>(structure->top_level) : nullptr;
}

Buffer::~Buffer() {
  memory_->evict(address(), size_bytes_);
  if (!mapping_) Memory::release(block_, size_bytes_);
}

}  // namespace kaamos::embree
