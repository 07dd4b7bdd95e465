// SPDX-License-Identifier: MIT
//
// Timestamps, and the commands that write and read them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace kaamos::runtime {

class BackendBuffer;

// Remembers by index which timestamps were written to it.
class BackendQueryHeap {
 public:
  explicit BackendQueryHeap(uint32_t count) : written_(count) {}
  virtual ~BackendQueryHeap() = default;

  // Tells whether a timestamp has been written when commands have run up to the present one. For
  // the thread that executes.
  bool written(uint32_t index) const { return written_[index]; }
  void set_written(uint32_t index) { written_[index] = true; }

 private:
  std::vector<bool> written_;
};

// The time when all earlier commands of the list are done.
struct TimestampCommand {
  std::shared_ptr<BackendQueryHeap> heap;
  uint32_t index = 0;
};

// Copies ticks, uint64_t each, to a buffer; 0 for timestamps that were never written.
struct ResolveTimestampsCommand {
  std::shared_ptr<BackendQueryHeap> heap;
  uint32_t first = 0;
  uint32_t count = 0;
  std::shared_ptr<BackendBuffer> dest;
  uint64_t dest_offset = 0;  // a multiple of 8
};

}  // namespace kaamos::runtime
