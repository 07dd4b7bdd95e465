// SPDX-License-Identifier: MIT
//
// The memory of buffers, and which acceleration structures are where in it. A GPU virtual address
// is the host address.
#pragma once

#include <cstdint>
#include <memory>

#include "runtime/backend/backend.h"
#include "runtime/embree/top_level.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::embree {

class Memory : public runtime::StructureMap {
 public:
  // Zeroed, at a multiple of 64 KiB; null if out of memory. Large blocks cost nothing until
  // touched.
  static uint8_t* allocate(uint64_t size_bytes);
  static void release(uint8_t* block, uint64_t size_bytes);

  // The top level at exactly this address, if its header is intact.
  std::shared_ptr<const TopLevel> find_top_level(uint64_t address) const;
};

// The bytes of a heap's pages, or of a block of its own.
class Buffer final : public runtime::BackendBuffer {
 public:
  Buffer(std::shared_ptr<Memory> memory, runtime::MappedPages mapping, uint64_t size_bytes)
      : memory_(std::move(memory)),
        mapping_(std::move(mapping)),
        block_(mapping_.first()),
        size_bytes_(size_bytes) {}
  Buffer(std::shared_ptr<Memory> memory, uint8_t* block, uint64_t size_bytes)
      : memory_(std::move(memory)), block_(block), size_bytes_(size_bytes) {}
  ~Buffer() override;

  uint64_t address() const override { return reinterpret_cast<uint64_t>(block_); }
  uint64_t size_bytes() const override { return size_bytes_; }
  uint8_t* host() const override { return block_; }

 private:
  std::shared_ptr<Memory> memory_;
  runtime::MappedPages mapping_;
  uint8_t* block_;
  uint64_t size_bytes_;
};

}  // namespace kaamos::embree
