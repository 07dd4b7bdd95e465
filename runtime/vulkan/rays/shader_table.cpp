// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/shader_table.h"

namespace kaamos::vulkan {

uint64_t translate_table(const ApplicationTable& table, runtime::RecordKind kind,
                         const runtime::IdentifierTable& identifiers, const GroupHandles& groups,
                         const TableLayout& layout, uint8_t* out) {
  const uint64_t stride = layout.stride();
  const uint64_t count = table.count();
  uint64_t unknown = kNoRecord;
  // Neighbouring records often have the same shaders.
  uint8_t last_identifier[kIdentifierBytes] = {};
  const uint8_t* last_handle = nullptr;
  for (uint64_t i = 0; i < count; ++i, out += stride) {
    alignas(8) uint8_t identifier[kIdentifierBytes];
    const uint64_t offset = i * table.stride_bytes;
    std::memcpy(identifier, table.host + offset, kIdentifierBytes);
    if (std::memcmp(identifier, last_identifier, kIdentifierBytes) != 0) {
      const runtime::LinkedRecord* record = identifiers.find(identifier);
      const bool suits = record != nullptr && record->kind == kind;
      if (!suits && unknown == kNoRecord && !runtime::is_null_identifier(identifier)) unknown = i;
      last_handle = suits ? groups.find(record) : nullptr;
      std::memcpy(last_identifier, identifier, kIdentifierBytes);
    }
    std::memset(out, 0, stride);
    if (last_handle == nullptr) continue;
    std::memcpy(out, last_handle, layout.handle_bytes);
    const uint64_t arguments = table.address + offset + kIdentifierBytes;
    std::memcpy(out + layout.handle_bytes, &arguments, sizeof(arguments));
  }
  return unknown;
}

uint64_t twins_of(runtime::RecordKind kind) {
  return kind == runtime::RecordKind::kHitGroup ? 3 : 1;
}

void translate_twins(const ApplicationTable& table, runtime::RecordKind kind,
                     const runtime::IdentifierTable& identifiers, const GroupHandles& groups,
                     const TableLayout& layout, uint8_t* out) {
  const uint64_t stride = layout.stride();
  const uint64_t count = table.count();
  const uint64_t twins = twins_of(kind);
  std::memset(out, 0, count * twins * stride);
  for (uint64_t i = 0; i < count; ++i) {
    alignas(8) uint8_t identifier[kIdentifierBytes];
    const uint64_t offset = i * table.stride_bytes;
    std::memcpy(identifier, table.host + offset, kIdentifierBytes);
    const runtime::LinkedRecord* record = identifiers.find(identifier);
    if (record == nullptr || record->kind != kind) continue;
    const uint64_t arguments = table.address + offset + kIdentifierBytes;
    const runtime::LinkedShader* of_hit[] = {record->any_hit, record->intersection,
                                             record->closest_hit};
    for (uint64_t k = 0; k < twins; ++k) {
      const uint8_t* handle = groups.find_twin(twins == 1 ? record->shader : of_hit[k]);
      if (handle == nullptr) continue;
      uint8_t* to = out + (i * twins + k) * stride;
      std::memcpy(to, handle, layout.handle_bytes);
      std::memcpy(to + layout.handle_bytes, &arguments, sizeof(arguments));
    }
  }
}

}  // namespace kaamos::vulkan
