// SPDX-License-Identifier: MIT
// What --tables, --explain and --heatmap print and write.
#pragma once

#include <string>

#include "options.h"
#include "renderer.h"

namespace northlight {

// Each pass with its name, as text or as one JSON object.
std::string print_tables(const std::vector<std::pair<std::string, rtapi::TableDescription>>& passes,
                         bool json);
std::string print_explanations(const std::vector<ExplainedDispatch>& dispatches, bool json);
// Writes <out>/heatmap-<kind>.png and describes its colors in `said`. Returns what went wrong.
std::string write_heatmap(const Options& options, const FrameResult& frame, std::string& said);

}  // namespace northlight
