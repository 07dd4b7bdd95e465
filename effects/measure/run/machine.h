// SPDX-License-Identifier: MIT
// The machine that measures.
#pragma once

#include <string>

namespace kaamos::measure {

// "2 threads, AMD EPYC 7B13".
std::string machine();

}  // namespace kaamos::measure
