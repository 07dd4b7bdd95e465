// SPDX-License-Identifier: MIT
//
// What a bug report needs to say about the machine.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kaamos::verify {

// Name and value, in the order in which they are printed. Devices are not among them: finding them
// loads drivers. A value that is not known says so.
std::vector<std::pair<std::string, std::string>> machine_facts();

// The instruction sets of this processor that matter to Kaamos or Embree, "sse4.2 avx avx2".
std::string vector_extensions();

}  // namespace kaamos::verify
