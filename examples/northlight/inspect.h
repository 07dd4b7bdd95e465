// SPDX-License-Identifier: MIT
// --tables, --explain and --heatmap: what is printed and written.
#pragma once

#include <string>

#include "options.h"
#include "renderer.h"

namespace northlight {

// Each pass under its name, as text or as one JSON object.
std::string print_tables(const std::vector<std::pair<std::string, rtapi::TableDescription>>& passes,
                         bool json);
std::string print_explanations(const std::vector<ExplainedDispatch>& dispatches, bool json);
// Writes <out>/heatmap-<kind>.png and sets `said` to what its colors mean. Returns what went wrong.
std::string write_heatmap(const Options& options, const FrameResult& frame, std::string& said);

}  // namespace northlight
