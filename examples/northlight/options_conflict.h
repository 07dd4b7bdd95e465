// SPDX-License-Identifier: MIT
// Finds options of northlight that exclude each other.
#pragma once

#include <string>

#include "options.h"

namespace northlight {

// Two options that were given and exclude each other, in a sentence; empty: there are none.
std::string conflict(const Options& options);

}  // namespace northlight
