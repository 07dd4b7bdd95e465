// SPDX-License-Identifier: MIT
//
// One input through the whole compiler but the host's C++ compiler.
#pragma once

#include <cstdint>
#include <string>

#include "mutate.h"

namespace kaamos::test {

// Empty, or which promise of the compiler was broken. `choice` picks the options.
std::string compile_input(const Corpus& corpus, const std::vector<std::string>& include_folders,
                          const Input& input, uint64_t choice);

}  // namespace kaamos::test
