// SPDX-License-Identifier: MIT
// The options that look at what a frame is made from.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "options.h"

namespace northlight {

void add_views(CLI::App& app, Options& options);
// Chooses the effects that are rendered if none are named: those that the views look at.
void choose_for_views(const Options& options, std::vector<std::string>& effects);
// Makes a frame of single effects a whole one if a view looks at what only that has.
void show_views(Options& options);

}  // namespace northlight
