// SPDX-License-Identifier: MIT
//
// Memory of buffers, and which acceleration structures stand where in it. A GPU virtual address is
// the host address. A structure is the bytes of an address range: a small header in them says that
// it is still there, so that writing over them ends it, as does a later build or copy to any part
// of the range, or the end of the buffer. [DXR: Data rules]
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <shared_mutex>
#include <vector>

#include <rtapi/raytracing.h>

#include "runtime/backend.h"
#include "runtime/embree/bottom_level.h"
#include "runtime/embree/top_level.h"

namespace kaamos::embree {

// What stands at an address. Exactly one of the two levels is set.
struct AccelerationStructure {
  uint64_t address = 0;
  uint64_t size_bytes = 0;       // CURRENT_SIZE: as prebuilt, or as compacted
  uint64_t compacted_bytes = 0;  // COMPACTED_SIZE: what Embree holds for it, at most size_bytes
  BuildFlags flags = BuildFlags::kNone;
  std::shared_ptr<BottomLevel> bottom_level;
  std::shared_ptr<const TopLevel> top_level;
  uint32_t instance_count = 0;  // top levels: NumDescs
};

class Memory {
 public:
  // Zeroed, a multiple of 64 KiB; null without memory. Large blocks cost nothing until touched.
  static uint8_t* allocate(uint64_t size_bytes);
  static void release(uint8_t* block, uint64_t size_bytes);

  // Ends what stands in the structure's range, and writes its header there.
  void place(AccelerationStructure structure);
  // Ends every structure that has bytes in the range.
  void evict(uint64_t address, uint64_t size_bytes);

  // The structure at exactly this address, if its bytes are untouched.
  std::shared_ptr<const AccelerationStructure> find(uint64_t address) const;
  std::shared_ptr<const TopLevel> find_top_level(uint64_t address) const;
  std::shared_ptr<const BottomLevel> find_bottom_level(uint64_t address) const;
  // Whether a second structure, a clone, uses the same bottom level.
  bool is_shared(const BottomLevel* level) const;

 private:
  struct Placed {
    uint64_t id;
    std::shared_ptr<const AccelerationStructure> structure;
  };
  void evict_locked(uint64_t address, uint64_t size_bytes);

  mutable std::shared_mutex mutex_;
  std::map<uint64_t, Placed> structures_;
  std::map<const BottomLevel*, uint32_t> owners_;
  uint64_t next_id_ = 1;
};

class Buffer final : public runtime::BackendBuffer {
 public:
  Buffer(std::shared_ptr<Memory> memory, uint8_t* block, uint64_t size_bytes)
      : memory_(std::move(memory)), block_(block), size_bytes_(size_bytes) {}
  ~Buffer() override;

  uint64_t address() const override { return reinterpret_cast<uint64_t>(block_); }
  uint64_t size_bytes() const override { return size_bytes_; }
  uint8_t* host() const override { return block_; }

 private:
  std::shared_ptr<Memory> memory_;
  uint8_t* block_;
  uint64_t size_bytes_;
};

}  // namespace kaamos::embree
