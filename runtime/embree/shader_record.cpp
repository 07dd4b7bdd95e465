// SPDX-License-Identifier: MIT
#include "runtime/embree/shader_record.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace kaamos::embree {
namespace {

// Records past this many (8 MiB of cells) have their identifiers looked up at every use.
constexpr uint64_t kMaxCachedRecords = uint64_t{1} << 20;

bool is_null_identifier(const uint8_t* identifier) {
  uint64_t words[4];
  std::memcpy(words, identifier, sizeof(words));
  return (words[0] | words[1] | words[2] | words[3]) == 0;
}

}  // namespace

const RecordTarget kNothing = {};

RecordTable::RecordTable(uint64_t start, uint64_t size_bytes, uint64_t stride_bytes,
                         RecordKind kind, TargetLookup lookup, RecordProblems* problems)
    : start_(reinterpret_cast<const uint8_t*>(start)),
      size_bytes_(size_bytes),
      stride_bytes_(stride_bytes),
      index_mask_(stride_bytes == 0 ? 0 : UINT64_MAX),
      kind_(kind),
      lookup_(lookup),
      problems_(problems) {
  if (start == 0 || size_bytes < kIdentifierBytes) return;
  count_ = stride_bytes == 0 ? 1 : (size_bytes - kIdentifierBytes) / stride_bytes + 1;
  const uint64_t wanted = std::min(count_, kMaxCachedRecords);
  // calloc, so that pages of a large table that no ray reaches are never touched.
  cache_.reset(static_cast<Cell*>(std::calloc(wanted, sizeof(Cell))));
  cached_ = cache_ ? wanted : 0;
}

uint32_t RecordTable::argument(uint64_t index, uint32_t offset) const {
  const uint64_t slot = index & index_mask_;
  if (slot >= count_) return 0;
  const uint64_t at = slot * stride_bytes_ + kIdentifierBytes + offset;
  uint32_t value = 0;
  if (at + sizeof(value) <= size_bytes_) std::memcpy(&value, start_ + at, sizeof(value));
  return value;
}

ShaderRecord RecordTable::resolve(uint64_t slot, uint64_t index) const {
  if (slot >= count_) {
    if (problems_ != nullptr) problems_->out_of_bounds.store(index, std::memory_order_relaxed);
    return {&kNothing, nullptr};
  }
  const RecordTarget* target = &kNothing;
  const uint8_t* address = start_ + slot * stride_bytes_;
  if (!is_null_identifier(address)) {
    const RecordTarget* found = lookup_.find(lookup_.self, address);
    if (found != nullptr && found->kind == kind_) {
      target = found;
    } else if (problems_ != nullptr) {
      problems_->unknown.store(slot, std::memory_order_relaxed);
    }
  }
  // Threads that get here at the same time store the same value.
  if (slot < cached_) cache_.get()[slot].store(target, std::memory_order_relaxed);
  return {target, address};
}

}  // namespace kaamos::embree
