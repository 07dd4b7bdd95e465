// SPDX-License-Identifier: MIT
//
// Holds what hit shaders need to know about an instance besides what the driver tells them. One
// table for all top levels of a device, because gl_InstanceCustomIndexEXT is the index into it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>

#include <kaamos/shader/spirv_interface.h>
#include <rtapi/result.h>

#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

class InstanceTable : public std::enable_shared_from_this<InstanceTable> {
 public:
  static rtapi::Result<std::shared_ptr<InstanceTable>> create(std::shared_ptr<Gpu> gpu);

  // Entries of one top level, freed with this object.
  class Range {
   public:
    Range() = default;
    Range(std::shared_ptr<InstanceTable> table, uint32_t first, uint32_t count)
        : table_(std::move(table)), first_(first), count_(count) {}
    Range(Range&& other) noexcept { swap(other); }
    Range& operator=(Range&& other) noexcept {
      swap(other);
      return *this;
    }
    ~Range();
    uint32_t first() const { return first_; }

   private:
    void swap(Range& other) noexcept {
      std::swap(table_, other.table_);
      std::swap(first_, other.first_);
      std::swap(count_, other.count_);
    }
    std::shared_ptr<InstanceTable> table_;
    uint32_t first_ = 0;
    uint32_t count_ = 0;
  };
  // Must not be called while a dispatch runs, because the table may move. Errors: KA0794 more than
  // 2^24 entries in all live top levels, KA0990 out of memory.
  // `position_tables` has one for each entry.
  rtapi::Result<Range> add(std::span<const shader::spirv::InstanceEntry> entries,
                           std::span<const uint64_t> position_tables);

  uint64_t address() const;
  uint64_t position_tables() const;  // DispatchBlock::position_tables

 private:
  explicit InstanceTable(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)) {}
  rtapi::Status grow(uint32_t entries);
  void release(uint32_t first, uint32_t count);

  std::shared_ptr<Gpu> gpu_;
  mutable std::mutex mutex_;
  std::unique_ptr<GpuBuffer> buffer_;  // the entries, then the position tables
  uint32_t capacity_ = 0;
  std::map<uint32_t, uint32_t> free_;  // first -> count; adjacent ranges are always merged
};

}  // namespace kaamos::vulkan
