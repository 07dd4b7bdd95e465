// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stress {

// Uses the driver in one way until `seconds` are over. Returns what was wrong; empty if nothing
// was. Runs in a process of its own.
struct Shape {
  const char* name;
  std::string (*run)(uint32_t seed, double seconds);
};
const std::vector<Shape>& shapes();

}  // namespace stress
