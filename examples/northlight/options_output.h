// SPDX-License-Identifier: MIT
// The options that say what of a frame is written.
#pragma once

#include <CLI/CLI.hpp>

#include "options.h"

namespace northlight {

void add_output(CLI::App& app, Options& options);

}  // namespace northlight
