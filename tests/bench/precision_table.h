// SPDX-License-Identifier: MIT
//
// kaamos-bench --precision-table: each precision of the Embree backend, and the Vulkan backend
// without and with padded boxes, side by side: speed, wrong hits, errors of hit data.
#pragma once

#include <iosfwd>

#include "suite.h"

namespace kaamos::bench {

// Prints Markdown. Returns the exit status of the program.
int print_precision_table(const Options& options, std::ostream& out, std::ostream& errors);

}  // namespace kaamos::bench
