// SPDX-License-Identifier: MIT
//
// Sends one input through the whole compiler except the host's C++ compiler, which reads batches.
#pragma once

#include <cstdint>
#include <string>

#include "cpp_batch.h"
#include "mutate.h"

namespace kaamos::test {

// Returns which of the compiler's guarantees was broken; empty if none. `choice` picks the options.
// The C++ goes to `batch`, unless that is null, as that of input `number`.
std::string compile_input(const Corpus& corpus, const std::vector<std::string>& include_folders,
                          const Input& input, uint64_t number, uint64_t choice, CppBatch* batch);

}  // namespace kaamos::test
