// SPDX-License-Identifier: MIT
//
// Guesses what is wrong with a table that has no identifier where one should be.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/checks/identifiers.h"

namespace kaamos::checks {

struct TableBytes {
  const uint8_t* host = nullptr;
  uint64_t size_bytes = 0;
  uint64_t stride_bytes = 0;
  uint64_t index = 0;         // of the record without an identifier
  uint64_t buffer_bytes = 0;  // from `host` to the end of its buffer
};

// One or two sentences: the stride at which there are identifiers, or how far off the first one is.
std::string advice_on_layout(const TableBytes& table, const runtime::IdentifierTable& own,
                             const Identifiers& all);

}  // namespace kaamos::checks
