// SPDX-License-Identifier: MIT
#include "runtime/embree/memory.h"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <mutex>
#include <utility>

namespace kaamos::embree {
namespace {

constexpr uint64_t kAlignment = 64 * 1024;  // of buffers, as D3D12's
constexpr uint64_t kMapped = 1024 * 1024;   // from here on pages come from the system one by one

struct Header {
  uint64_t magic;
  uint64_t id;
};
constexpr uint64_t kMagic = 0x53414B414D4F5341;

uint64_t rounded(uint64_t bytes) {
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

}  // namespace

uint8_t* Memory::allocate(uint64_t size_bytes) {
  const uint64_t bytes = rounded(size_bytes);
  if (bytes < kMapped) {
    void* block = std::aligned_alloc(kAlignment, bytes);
    if (block != nullptr) std::memset(block, 0, bytes);
    return static_cast<uint8_t*>(block);
  }
  void* mapped = mmap(nullptr, bytes + kAlignment, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  auto* start = static_cast<uint8_t*>(mapped);
  auto* aligned = reinterpret_cast<uint8_t*>(rounded(reinterpret_cast<uint64_t>(start)));
  if (aligned != start) munmap(start, aligned - start);
  const uint64_t rest = start + kAlignment - aligned;
  if (rest != 0) munmap(aligned + bytes, rest);
  return aligned;
}

void Memory::release(uint8_t* block, uint64_t size_bytes) {
  const uint64_t bytes = rounded(size_bytes);
  if (bytes < kMapped) {
    std::free(block);
  } else {
    munmap(block, bytes);
  }
}

void Memory::place(AccelerationStructure structure) {
  const uint64_t address = structure.address;
  const std::unique_lock lock(mutex_);
  evict_locked(address, structure.size_bytes);
  const Header header = {kMagic, next_id_++};
  std::memcpy(reinterpret_cast<void*>(address), &header, sizeof(header));
  if (structure.bottom_level) ++owners_[structure.bottom_level.get()];
  structures_[address] = {header.id,
                          std::make_shared<const AccelerationStructure>(std::move(structure))};
}

void Memory::evict(uint64_t address, uint64_t size_bytes) {
  const std::unique_lock lock(mutex_);
  evict_locked(address, size_bytes);
}

void Memory::evict_locked(uint64_t address, uint64_t size_bytes) {
  auto it = structures_.lower_bound(address);
  if (it != structures_.begin()) {
    const auto before = std::prev(it);
    if (address - before->first < before->second.structure->size_bytes) it = before;
  }
  while (it != structures_.end() && (it->first < address || it->first - address < size_bytes)) {
    if (const BottomLevel* level = it->second.structure->bottom_level.get()) {
      const auto owner = owners_.find(level);
      if (--owner->second == 0) owners_.erase(owner);
    }
    it = structures_.erase(it);
  }
}

std::shared_ptr<const AccelerationStructure> Memory::find(uint64_t address) const {
  Placed placed;
  {
    const std::shared_lock lock(mutex_);
    const auto it = structures_.find(address);
    if (it == structures_.end()) return nullptr;
    placed = it->second;
  }
  // Outside the lock: memory that the application freed meanwhile faults here.
  Header header;
  std::memcpy(&header, reinterpret_cast<const void*>(address), sizeof(header));
  if (header.magic != kMagic || header.id != placed.id) return nullptr;
  return placed.structure;
}

std::shared_ptr<const TopLevel> Memory::find_top_level(uint64_t address) const {
  const auto structure = find(address);
  return structure ? structure->top_level : nullptr;
}

std::shared_ptr<const BottomLevel> Memory::find_bottom_level(uint64_t address) const {
  const auto structure = find(address);
  return structure ? structure->bottom_level : nullptr;
}

bool Memory::is_shared(const BottomLevel* level) const {
  const std::shared_lock lock(mutex_);
  const auto owner = owners_.find(level);
  return owner != owners_.end() && owner->second > 1;
}

Buffer::~Buffer() {
  memory_->evict(address(), size_bytes_);
  Memory::release(block_, size_bytes_);
}

}  // namespace kaamos::embree
