// SPDX-License-Identifier: MIT
//
// kaamos-bench --raster-table: how draws scale with triangles, pixels and threads.
#pragma once

#include <iosfwd>

#include "suite.h"

namespace kaamos::bench {

// Prints Markdown. Returns the program's exit status.
int print_raster_table(const Options& options, std::ostream& out, std::ostream& errors);

}  // namespace kaamos::bench
