// SPDX-License-Identifier: MIT
//
// kaamos-bench --precision-table: compares speed, wrong hits and errors of hit data of each
// precision of the Embree backend and of the Vulkan backend, without and with padded boxes.
#pragma once

#include <iosfwd>

#include "suite.h"

namespace kaamos::bench {

// Prints Markdown. Returns the program's exit status.
int print_precision_table(const Options& options, std::ostream& out, std::ostream& errors);

}  // namespace kaamos::bench
