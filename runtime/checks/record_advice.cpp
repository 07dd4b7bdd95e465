// SPDX-License-Identifier: MIT
#include "runtime/checks/record_advice.h"

#include <algorithm>

namespace kaamos::checks {
namespace {

// The bytes to search for identifiers; no record is longer.
constexpr uint64_t kReach = 4096;

}  // namespace

std::string advice_on_layout(const TableBytes& table, const runtime::IdentifierTable& own,
                             const Identifiers& all) {
  const auto identifier_at = [&](uint64_t offset) {
    if (offset + 32 > std::min(table.size_bytes, table.buffer_bytes)) return false;
    const uint8_t* bytes = table.host + offset;
    return own.find(bytes) != nullptr || !all.find(bytes).empty();
  };
  const auto next_after = [&](uint64_t offset) -> uint64_t {
    for (uint64_t i = offset + 8; i < offset + kReach; i += 8) {
      if (identifier_at(i)) return i - offset;
    }
    return 0;
  };
  if (table.index > 0 && identifier_at(0)) {
    const uint64_t distance = next_after(0);
    if (distance != 0 && distance != table.stride_bytes) {
      return "The table has identifiers every " + std::to_string(distance) +
             " bytes: was it written with a stride of " + std::to_string(distance) +
             "? StrideInBytes must be the same" +
             (distance % 32 != 0 ? ", and a multiple of 32." : ".");
    }
  }
  const uint64_t here = table.index * table.stride_bytes;
  if (const uint64_t distance = next_after(here); distance != 0 && table.index == 0) {
    return "There is an identifier " + std::to_string(distance) +
           " bytes further on: does the table start there?";
  }
  return "Write the 32 bytes that GetShaderIdentifier returns to the start of each record that "
         "can be reached, or zeros for a record that runs nothing.";
}

}  // namespace kaamos::checks
