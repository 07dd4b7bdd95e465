// SPDX-License-Identifier: MIT
#include "runtime/backend/heap_memory.h"

#include <sys/mman.h>
#include <unistd.h>

namespace kaamos::runtime {
namespace {

constexpr uint64_t kAlignment = 64 * 1024;  // of addresses of buffers, as in D3D12

uint64_t rounded(uint64_t bytes, uint64_t to) {
  return (bytes + to - 1) / to * to;
}

uint64_t page_bytes() {
  static const auto bytes = static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  return bytes;
}

// Addresses of nothing at a multiple of the alignment; null if there are none left.
uint8_t* reserve(uint64_t bytes) {
  void* mapped = mmap(nullptr, bytes + kAlignment, PROT_NONE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  auto* start = static_cast<uint8_t*>(mapped);
  const uint64_t before = -reinterpret_cast<uint64_t>(start) % kAlignment;
  if (before != 0) munmap(start, before);
  if (before != kAlignment) munmap(start + before + bytes, kAlignment - before);
  return start + before;
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
  const uint64_t bytes = rounded(size_bytes, kAlignment);
  void* mapped = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  return std::shared_ptr<HeapMemory>(
      new HeapMemory(MappedPages(static_cast<uint8_t*>(mapped), bytes), bytes));
}

// mremap of no bytes of shared pages makes a second mapping of them. [mremap(2)]
MappedPages HeapMemory::map(uint64_t offset_bytes, uint64_t size_bytes) const {
  const uint64_t bytes = rounded(size_bytes, page_bytes());
  uint8_t* to = reserve(bytes);
  if (to == nullptr) return {};
  void* mapped = mremap(all_.first() + offset_bytes, 0, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, to);
  if (mapped == MAP_FAILED) {
    munmap(to, bytes);
    return {};
  }
  return {to, bytes};
}

}  // namespace kaamos::runtime
