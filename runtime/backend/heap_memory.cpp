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

uint8_t* map_shared(uint64_t bytes, int file) {
  const int kind = file < 0 ? MAP_ANONYMOUS : 0;
  void* mapped =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | kind | MAP_NORESERVE, file, 0);
  return mapped == MAP_FAILED ? nullptr : static_cast<uint8_t*>(mapped);
}

// mremap of no bytes of shared pages makes a second mapping of them. [mremap(2)] qemu, which runs
// programs for other processors, refuses.
bool maps_pages_twice() {
  static const bool answer = [] {
    const MappedPages page(map_shared(page_bytes(), -1), page_bytes());
    if (!page) return false;
    void* second = mremap(page.first(), 0, page_bytes(), MREMAP_MAYMOVE);
    if (second == MAP_FAILED) return false;
    munmap(second, page_bytes());
    return true;
  }();
  return answer;
}

// Files number 1,024 in a process by default, so a heap has one only if it must. -1 without one.
int file_of(uint64_t bytes) {
  const int file = memfd_create("kaamos heap", MFD_CLOEXEC);
  if (file < 0 || ftruncate(file, static_cast<off_t>(bytes)) == 0) return file;
  close(file);
  return -1;
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
  const int file = maps_pages_twice() ? -1 : file_of(bytes);
  uint8_t* mapped = map_shared(bytes, file);
  if (mapped == nullptr) {
    if (file >= 0) close(file);
    return nullptr;
  }
  return std::shared_ptr<HeapMemory>(new HeapMemory(MappedPages(mapped, bytes), bytes, file));
}

HeapMemory::~HeapMemory() {
  if (file_ >= 0) close(file_);
}

MappedPages HeapMemory::map(uint64_t offset_bytes, uint64_t size_bytes) const {
  const uint64_t bytes = round_up(size_bytes, page_bytes());
  uint8_t* to = map_aligned(bytes, PROT_NONE);
  if (to == nullptr) return {};
  void* mapped =
      file_ < 0 ? mremap(all_.first() + offset_bytes, 0, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, to)
                : mmap(to, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED | MAP_NORESERVE,
                       file_, static_cast<off_t>(offset_bytes));
  if (mapped == MAP_FAILED) {
    munmap(to, bytes);
    return {};
  }
  return {to, bytes};
}

}  // namespace kaamos::runtime
