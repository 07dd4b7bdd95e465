// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stress {

// A use of the driver that is repeated until `seconds` are over. Returns an empty text, or what was
// wrong. Runs in a process of its own.
struct Shape {
  const char* name;
  std::string (*run)(uint32_t seed, double seconds);
};
const std::vector<Shape>& shapes();

}  // namespace stress
