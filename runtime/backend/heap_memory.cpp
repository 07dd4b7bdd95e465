// SPDX-License-Identifier: MIT
#include "runtime/backend/heap_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include "runtime/backend/aligned_pages.h"

namespace kaamos::runtime {
namespace {

uint64_t page_bytes() {
  static const auto bytes = static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  return bytes;
}

}  // namespace

MappedPages& MappedPages::operator=(MappedPages&& other) noexcept {
  std::swap(first_, other.first_);
  std::swap(size_bytes_, other.size_bytes_);
  return *this;
}

MappedPages::~MappedPages() {
  if (first_ != nullptr) munmap(first_, size_bytes_);
}

std::shared_ptr<HeapMemory> HeapMemory::create(uint64_t size_bytes) {
  const uint64_t bytes = round_up(size_bytes, kBufferAlignment);
  void* mapped = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  return std::shared_ptr<HeapMemory>(
      new HeapMemory(MappedPages(static_cast<uint8_t*>(mapped), bytes), bytes));
}

// mremap of no bytes of shared pages makes a second mapping of them. [mremap(2)]
MappedPages HeapMemory::map(uint64_t offset_bytes, uint64_t size_bytes) const {
  const uint64_t bytes = round_up(size_bytes, page_bytes());
  uint8_t* to = map_aligned(bytes, PROT_NONE);
  if (to == nullptr) return {};
  void* mapped = mremap(all_.first() + offset_bytes, 0, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, to);
  if (mapped == MAP_FAILED) {
    munmap(to, bytes);
    return {};
  }
  return {to, bytes};
}

}  // namespace kaamos::runtime
