// SPDX-License-Identifier: MIT
//
// Writes names and numbers as they stand in messages.
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>

namespace kaamos::errors {

// Each part as a std::ostream writes it, one after another.
template <class... Parts>
std::string concat(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

std::string in_quotes(std::string_view name);  // "\"name\""
std::string hex(uint64_t value);               // "0x1f"

}  // namespace kaamos::errors
