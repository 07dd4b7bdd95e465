// SPDX-License-Identifier: MIT
//
// The memory of a heap. Each resource that is placed in it maps its part at an address of its own,
// so that resources that overlap share bytes and no address: whatever finds a buffer by an address
// finds one.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

namespace kaamos::runtime {

// Pages of this process, unmapped with the object. Those of a heap outlive it.
class MappedPages {
 public:
  MappedPages() = default;  // of nothing
  MappedPages(uint8_t* first, uint64_t size_bytes) : first_(first), size_bytes_(size_bytes) {}
  MappedPages(MappedPages&& other) noexcept { *this = std::move(other); }
  MappedPages& operator=(MappedPages&& other) noexcept;
  ~MappedPages();

  explicit operator bool() const { return first_ != nullptr; }
  uint8_t* first() const { return first_; }  // at a multiple of 64 KiB
  uint64_t size_bytes() const { return size_bytes_; }

 private:
  uint8_t* first_ = nullptr;
  uint64_t size_bytes_ = 0;
};

class HeapMemory {
 public:
  // Zeros, which cost nothing until they are touched; null if out of memory.
  static std::shared_ptr<HeapMemory> create(uint64_t size_bytes);
  ~HeapMemory();
  HeapMemory(const HeapMemory&) = delete;
  HeapMemory& operator=(const HeapMemory&) = delete;

  uint64_t size_bytes() const { return size_bytes_; }
  // Bytes [offset, offset + size) in whole pages; the offset is a multiple of 4 KiB. Nothing if out
  // of memory. Thread-safe.
  MappedPages map(uint64_t offset_bytes, uint64_t size_bytes) const;

 private:
  HeapMemory(MappedPages all, uint64_t size_bytes, int file)
      : all_(std::move(all)), size_bytes_(size_bytes), file_(file) {}

  MappedPages all_;
  uint64_t size_bytes_;
  int file_;  // whose pages they are, where the system cannot map pages a second time; else -1
};

// Where a resource lies; the bytes are inside of the heap.
struct HeapPlace {
  const HeapMemory* heap = nullptr;
  uint64_t offset_bytes = 0;
  uint64_t size_bytes = 0;

  MappedPages map() const { return heap->map(offset_bytes, size_bytes); }
};

}  // namespace kaamos::runtime
