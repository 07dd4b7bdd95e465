// SPDX-License-Identifier: MIT
#include "runtime/errors/text.h"

#include <cstdio>

namespace kaamos::errors {

std::string in_quotes(std::string_view name) {
  return "\"" + std::string(name) + "\"";
}

std::string hex(uint64_t value) {
  char text[2 + 16 + 1];
  std::snprintf(text, sizeof(text), "0x%llx", static_cast<unsigned long long>(value));
  return text;
}

}  // namespace kaamos::errors
