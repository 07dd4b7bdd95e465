// SPDX-License-Identifier: MIT
//
// Sends one input through the whole compiler except the host's C++ compiler.
#pragma once

#include <cstdint>
#include <string>

#include "mutate.h"

namespace kaamos::test {

// Returns which of the compiler's guarantees was broken; empty if none. `choice` picks the options.
std::string compile_input(const Corpus& corpus, const std::vector<std::string>& include_folders,
                          const Input& input, uint64_t choice);

}  // namespace kaamos::test
