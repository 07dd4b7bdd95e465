// SPDX-License-Identifier: MIT
//
// Decides how much a test of this folder does: little in a normal run, less under a sanitizer,
// which makes every ray ten times as slow and looks for other faults than wrong digits, and
// everything with KAAMOS_FULL=1.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace kaamos::test {

inline bool is_full_size() {
  const char* wanted = std::getenv("KAAMOS_FULL");
  return wanted != nullptr && wanted[0] != '\0' && wanted[0] != '0';
}

constexpr bool is_sanitized() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return true;
#elif defined(__has_feature)
  return __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
  return false;
#endif
}

inline std::uint32_t by_size(std::uint32_t sanitized, std::uint32_t quick, std::uint32_t full) {
  return is_full_size() ? full : is_sanitized() ? sanitized : quick;
}

}  // namespace kaamos::test
