// SPDX-License-Identifier: MIT
//
// What is likely wrong with a table in which no identifier stands where one should.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/checks/identifiers.h"

namespace kaamos::checks {

struct TableBytes {
  const uint8_t* host = nullptr;
  uint64_t size_bytes = 0;
  uint64_t stride_bytes = 0;
  uint64_t index = 0;         // of the record that holds none
  uint64_t buffer_bytes = 0;  // from `host` to the end of its buffer
};

// One or two sentences: the stride at which identifiers do stand, or how far the first one is off.
std::string advice_on_layout(const TableBytes& table, const runtime::IdentifierTable& own,
                             const Identifiers& all);

}  // namespace kaamos::checks
