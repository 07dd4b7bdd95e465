// SPDX-License-Identifier: MIT
//
// Links the SPIR-V of a geometry or pixel shader to that of the shader before it: both were
// compiled alone, and what goes from one to the other is found by its semantic. [spirv_interface.h]
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

namespace kaamos::shader::spirv {

// The modules below must be the compiler's.

// Calls visit(decoration) for the words of each decoration that gives a variable of a storage class
// its location.
template <typename Visit>
void each_location(std::span<uint32_t> words, uint32_t storage_class, const Visit& visit) {
  constexpr uint32_t kVariable = 59, kDecorate = 71, kLocation = 30;
  constexpr size_t kHeader = 5;
  const auto each = [&](const auto& look) {
    for (size_t at = kHeader; at < words.size();) {
      const uint32_t length = words[at] >> 16;
      if (length == 0 || at + length > words.size()) return;
      look(words[at] & 0xFFFFu, words.subspan(at, length));
      at += length;
    }
  };
  std::unordered_set<uint32_t> variables;
  each([&](uint32_t op, std::span<uint32_t> instruction) {
    if (op == kVariable && instruction.size() >= 4 && instruction[3] == storage_class) {
      variables.insert(instruction[2]);
    }
  });
  each([&](uint32_t op, std::span<uint32_t> instruction) {
    if (op == kDecorate && instruction.size() == 4 && instruction[2] == kLocation &&
        variables.count(instruction[1]) != 0) {
      visit(instruction);
    }
  });
}

// Instead of a location: the built-in position of the shader before.
inline constexpr uint32_t kPositionLocation = 0xFFFFFFFFu;

// Gives each input at a location n the location `locations[n]`; inputs past the end of the list
// keep theirs.
inline void relocate_inputs(std::span<uint32_t> words, std::span<const uint32_t> locations) {
  constexpr uint32_t kInputClass = 1, kBuiltIn = 11, kPosition = 0;
  each_location(words, kInputClass, [&](std::span<uint32_t> decoration) {
    uint32_t& location = decoration[3];
    if (location >= locations.size()) return;
    location = locations[location];
    if (location != kPositionLocation) return;
    decoration[2] = kBuiltIn;
    location = kPosition;
  });
}

// Makes the output at location 1 the second source of blending at location 0: in Vulkan, index 1.
inline void make_second_source(std::vector<uint32_t>& words) {
  constexpr uint32_t kOutputClass = 3, kIndex = 32;
  std::vector<uint32_t> index;
  size_t behind = 0;
  each_location(words, kOutputClass, [&](std::span<uint32_t> decoration) {
    if (decoration[3] != 1) return;
    decoration[3] = 0;
    index = {decoration[0], decoration[1], kIndex, 1};
    behind = static_cast<size_t>(decoration.data() - words.data()) + decoration.size();
  });
  words.insert(words.begin() + static_cast<std::ptrdiff_t>(behind), index.begin(), index.end());
}

}  // namespace kaamos::shader::spirv
