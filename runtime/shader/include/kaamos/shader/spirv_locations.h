// SPDX-License-Identifier: MIT
//
// Links the SPIR-V of a pixel shader to that of a vertex shader: both were compiled alone, and what
// goes from one to the other is found by its semantic. [spirv_interface.h]
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

namespace kaamos::shader::spirv {

// Gives each input at a location n the location `locations[n]`; inputs past the end of the list
// keep theirs. The module must be one of the compiler's.
inline void relocate_inputs(std::span<uint32_t> words, std::span<const uint32_t> locations) {
  constexpr uint32_t kVariable = 59, kDecorate = 71, kInputClass = 1, kLocation = 30;
  constexpr size_t kHeader = 5;
  const auto each = [&](const auto& visit) {
    for (size_t at = kHeader; at < words.size();) {
      const uint32_t length = words[at] >> 16;
      if (length == 0 || at + length > words.size()) return;
      visit(words[at] & 0xFFFFu, words.subspan(at, length));
      at += length;
    }
  };
  std::unordered_set<uint32_t> inputs;
  each([&](uint32_t op, std::span<uint32_t> instruction) {
    if (op == kVariable && instruction.size() >= 4 && instruction[3] == kInputClass) {
      inputs.insert(instruction[2]);
    }
  });
  each([&](uint32_t op, std::span<uint32_t> instruction) {
    const bool places = op == kDecorate && instruction.size() == 4 && instruction[2] == kLocation &&
                        inputs.count(instruction[1]) != 0;
    if (places && instruction[3] < locations.size()) instruction[3] = locations[instruction[3]];
  });
}

}  // namespace kaamos::shader::spirv
