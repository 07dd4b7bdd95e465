// SPDX-License-Identifier: MIT
//
// Shader tables: from a record's index to the code that runs. Tables are plain memory, read while
// the dispatch executes [DXR: Shader tables]. Each record's 32-byte identifier is looked up once
// per dispatch, when a ray first reaches the record, so that records nobody reaches may contain
// anything.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "kaamos/shader/abi.h"
#include "runtime/backend/linked_pipeline.h"

namespace kaamos::runtime {
struct LinkedShader;
}

namespace kaamos::embree {

// Size of a shader identifier, at the start of every record. [DXR: Shader identifier]
inline constexpr uint64_t kIdentifierBytes = 32;

// One linked export: its code, and where its bindings come from. A cache line.
struct alignas(64) Shader {
  const char* name = "";
  shader::AnyFn entry = nullptr;
  const shader::BindingSlot* slots = nullptr;
  uint32_t stack_bytes = 0;  // its share of the pipeline's stack
  bool reads_hit_kind = false;
  uint32_t number = 0;                            // among the pipeline's shaders
  const runtime::LinkedShader* linked = nullptr;  // for messages; may be null

  bool runs() const { return entry != nullptr; }

  template <typename Function>
  Function as() const {
    return reinterpret_cast<Function>(entry);
  }
};

using runtime::RecordKind;

// The shaders that an identifier stands for. Absent shaders run nothing, so kNothing below serves
// for null identifiers, records out of bounds and identifiers of the wrong kind alike. Shaders are
// held by value, so that what a hit runs is two loads away instead of three.
struct RecordTarget {
  Shader shader;   // ray generation, miss, callable
  Shader any_hit;  // hit groups
  Shader closest_hit;
  Shader intersection;
  RecordKind kind = RecordKind::kNone;
  bool procedural = false;  // hit groups: D3D12_HIT_GROUP_TYPE_PROCEDURAL_PRIMITIVE
};

extern const RecordTarget kNothing;

// Finds what an identifier stands for by comparing all 32 bytes; null if it is unknown.
struct TargetLookup {
  const RecordTarget* (*find)(const void* self, const uint8_t* identifier) = nullptr;
  const void* self = nullptr;
};

// Records that were reached in a table but should not have been; one example of each sort is kept.
struct RecordProblems {
  static constexpr uint64_t kNone = UINT64_MAX;
  std::atomic<uint64_t> out_of_bounds = kNone;  // an index past the table
  std::atomic<uint64_t> unknown = kNone;  // a record without an identifier of the table's kind
};

struct ShaderRecord {
  const RecordTarget* target;  // never null
  const uint8_t* address;      // null if target is kNothing

  const uint8_t* local_arguments() const { return address + kIdentifierBytes; }
};

// One table of a dispatch, shared by its threads.
class RecordTable {
 public:
  RecordTable() = default;
  // start, size_bytes, stride_bytes as in D3D12_GPU_VIRTUAL_ADDRESS_RANGE_AND_STRIDE.
  RecordTable(uint64_t start, uint64_t size_bytes, uint64_t stride_bytes, RecordKind kind,
              TargetLookup lookup, RecordProblems* problems);

  // A stride of 0 makes every index the first record [DXR: Shader record stride]; an index past
  // size_bytes runs nothing [DXR: Out of bounds shader table indexing].
  ShaderRecord at(uint64_t index) const {
    const uint64_t slot = index & index_mask_;
    if (slot < cached_) [[likely]] {
      const RecordTarget* target = cache_.get()[slot].load(std::memory_order_relaxed);
      if (target != nullptr) [[likely]]
        return {target, start_ + slot * stride_bytes_};
    }
    return resolve(slot, index);
  }

  // The DWORD `offset` bytes into the local root arguments of a record, whatever its identifier; 0
  // past the table's end.
  uint32_t argument(uint64_t index, uint32_t offset) const;

  // The number of records inside size_bytes; 1 for a stride of 0.
  uint64_t count() const { return count_; }

 private:
  using Cell = std::atomic<const RecordTarget*>;
  struct Free {
    void operator()(Cell* cells) const { std::free(cells); }
  };

  ShaderRecord resolve(uint64_t slot, uint64_t index) const;

  const uint8_t* start_ = nullptr;
  uint64_t size_bytes_ = 0;
  uint64_t stride_bytes_ = 0;
  uint64_t index_mask_ = 0;  // 0 if the stride is 0
  uint64_t count_ = 0;
  uint64_t cached_ = 0;  // how many of the first records have a cell, at most count_
  RecordKind kind_ = RecordKind::kNone;
  TargetLookup lookup_;
  RecordProblems* problems_ = nullptr;
  std::unique_ptr<Cell, Free> cache_;
};

// Index of a hit record: three masked terms, summed in 64 bits without masking. [DXR: Hit group
// table indexing]
inline uint64_t hit_record_index(uint32_t ray_contribution, uint32_t multiplier,
                                 uint32_t geometry_index, uint32_t instance_contribution) {
  return uint64_t{ray_contribution & 0xFu} + uint64_t{multiplier & 0xFu} * geometry_index +
         (instance_contribution & 0xFFFFFFu);
}

}  // namespace kaamos::embree
