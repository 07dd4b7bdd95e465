// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/buffer_members.h"

#include <algorithm>

#include "runtime/hlsl/check/names/layout.h"

namespace kaamos::hlsl {
namespace {

uint64_t next_row(uint64_t offset) {
  return (offset + kRowBytes - 1) / kRowBytes * kRowBytes;
}

// Finds places for members in turn.
class Rows {
 public:
  explicit Rows(uint64_t end) : end_(end) {}

  uint64_t place(const BufferMember& member) {
    if (member.size == 0) return end_;
    const Type* type = member.type;
    const bool begins_row = type->is_array() || type->is_struct();
    if (begins_row) end_ = next_row(end_);
    if (!type->is_array()) {
      // With native 16-bit types the min types are ordinary ones.
      const bool is_min = type->is_numeric() && is_min_precision(type->scalar) &&
                          scalar_bytes(type->scalar, ScalarStorage::kBuffer) == 4;
      if (is_min != after_min_) end_ = next_row(end_);
      after_min_ = is_min;
    }
    const uint64_t at =
        begins_row
            ? end_
            : place_member(type, static_cast<uint32_t>(std::min<uint64_t>(end_, kMaxLayoutBytes)),
                           ir::Layout::kConstantBuffer);
    end_ = at + member.size;
    return at;
  }

 private:
  uint64_t end_;
  bool after_min_ = false;  // whether the last one was of a min16 type
};

}  // namespace

PlacedMembers place_members(const std::vector<BufferMember>& members, ir::Struct& structure) {
  PlacedMembers placed;
  uint64_t end = 0;
  const auto place = [&](const BufferMember& member, uint64_t at) {
    end = std::max(end, at + member.size);
    if (end > kMaxBufferBytes && !placed.too_far) placed.too_far = &member;
    for (const BufferMember::Part& part : member.parts) {
      const uint64_t offset = std::min<uint64_t>(at + part.offset, kMaxLayoutBytes);
      part.variable->offset = static_cast<uint32_t>(offset);
      structure.fields[part.field].packoffset = static_cast<int32_t>(offset);
    }
  };
  for (const BufferMember& member : members) {
    if (member.written >= 0) place(member, static_cast<uint64_t>(member.written));
  }
  Rows rows(end);
  for (const BufferMember& member : members) {
    if (member.written < 0) place(member, rows.place(member));
  }
  placed.size = static_cast<uint32_t>(std::min<uint64_t>(end, kMaxLayoutBytes));
  return placed;
}

}  // namespace kaamos::hlsl
