// SPDX-License-Identifier: MIT
//
// Translates the application's shader tables into the driver's. The application's records stay
// where they are: a record of the driver's table is the handle of the group that the identifier
// stands for, and the address of the local arguments. A null record, all zero, runs nothing. [DXR:
// Shader tables]
#pragma once

#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

#include "runtime/backend/linked_pipeline.h"

namespace kaamos::vulkan {

// Size of a shader identifier, at the start of every record. [DXR: Shader identifier]
inline constexpr uint64_t kIdentifierBytes = 32;

// The driver's handles for the shaders of records.
class GroupHandles {
 public:
  explicit GroupHandles(uint32_t handle_bytes = 32) : handle_bytes_(handle_bytes) {}
  void add(const runtime::LinkedRecord* record, const uint8_t* handle) {
    offsets_[record] = bytes_.size();
    bytes_.insert(bytes_.end(), handle, handle + handle_bytes_);
  }
  void add_twin(const runtime::LinkedShader* shader, const uint8_t* handle) {
    twins_[shader] = bytes_.size();
    bytes_.insert(bytes_.end(), handle, handle + handle_bytes_);
  }
  // Null for a shader that is null.
  const uint8_t* find_twin(const runtime::LinkedShader* shader) const {
    const auto it = twins_.find(shader);
    return it == twins_.end() ? nullptr : bytes_.data() + it->second;
  }
  // Null for a record without a group, for which nothing runs.
  const uint8_t* find(const runtime::LinkedRecord* record) const {
    const auto it = offsets_.find(record);
    return it == offsets_.end() ? nullptr : bytes_.data() + it->second;
  }
  uint32_t handle_bytes() const { return handle_bytes_; }

 private:
  uint32_t handle_bytes_;
  std::vector<uint8_t> bytes_;
  std::unordered_map<const runtime::LinkedRecord*, size_t> offsets_;
  std::unordered_map<const runtime::LinkedShader*, size_t> twins_;
};

// A table of the application, as in D3D12_GPU_VIRTUAL_ADDRESS_RANGE_AND_STRIDE.
struct ApplicationTable {
  const uint8_t* host = nullptr;  // the bytes at address; null: no table
  uint64_t address = 0;
  uint64_t size_bytes = 0;
  uint64_t stride_bytes = 0;

  // The number of records inside size_bytes; 1 for a stride of 0, where every index means the first
  // record. [DXR: Shader record stride]
  uint64_t count() const {
    if (host == nullptr || size_bytes < kIdentifierBytes) return 0;
    return stride_bytes == 0 ? 1 : (size_bytes - kIdentifierBytes) / stride_bytes + 1;
  }
};

// The layout that a driver wants for its tables.
struct TableLayout {
  uint32_t handle_bytes = 32;
  uint32_t handle_alignment = 32;
  uint32_t base_alignment = 64;

  // The distance between records, each of which has a handle and spirv::RecordData.
  uint64_t stride() const {
    return (handle_bytes + sizeof(uint64_t) + handle_alignment - 1) / handle_alignment *
           handle_alignment;
  }
  uint64_t aligned(uint64_t offset) const {
    return (offset + base_alignment - 1) / base_alignment * base_alignment;
  }
};

inline constexpr uint64_t kNoRecord = UINT64_MAX;

// Writes the records of `table` to `out`, layout.stride() apart, with every byte defined. A record
// whose identifier is not null and not a `kind` of this pipeline becomes a null record; returns the
// index of one of those, or kNoRecord.
uint64_t translate_table(const ApplicationTable& table, runtime::RecordKind kind,
                         const runtime::IdentifierTable& identifiers, const GroupHandles& groups,
                         const TableLayout& layout, uint8_t* out);

// The number of twins of a record: any-hit, intersection, closest-hit, or miss.
uint64_t twins_of(runtime::RecordKind kind);
// Writes records with the twins of those of `table`, twins_of(kind) for each, likewise.
void translate_twins(const ApplicationTable& table, runtime::RecordKind kind,
                     const runtime::IdentifierTable& identifiers, const GroupHandles& groups,
                     const TableLayout& layout, uint8_t* out);

}  // namespace kaamos::vulkan
