// SPDX-License-Identifier: MIT
// Collects, prints and writes what --tables, --explain and --heatmap look at.
#pragma once

#include <rtapi/explain.h>
#include <rtapi/explain_draw.h>
#include <rtapi/table_description.h>

#include <string>
#include <utility>
#include <vector>

#include "effects/northlight/frame_renderer.h"
#include "options.h"

namespace northlight {

// A dispatch that contains the pixel of --explain.
struct ExplainedDispatch {
  std::string pass;
  std::uint32_t first_row = 0;  // of the band; the dispatch's y starts there
  rtapi::PixelExplanation pixel;
};

// The explanations and counts that were taken of a frame.
struct Inspection {
  std::vector<ExplainedDispatch> explained;          // with --explain
  std::vector<rtapi::PixelStatistics> pixel_counts;  // with --heatmap: width * height
  std::vector<std::uint32_t> overdraw;  // --heatmap overdraw: pixel shaders that ran, row by row
};

// Makes the renderer's next frames fill `seen`, which must stay, as the options ask for.
void inspect(const Options& options, kaamos::effects::FrameRenderer& renderer, Inspection& seen);

using PassTables = std::vector<std::pair<std::string, rtapi::TableDescription>>;
// The shader tables of each pass, with its name.
rtapi::Result<PassTables> describe_tables(const kaamos::effects::FrameRenderer& renderer);
// Each pass with its name, as text or as one JSON object.
std::string print_tables(const PassTables& passes, bool json);
std::string print_explanations(const std::vector<ExplainedDispatch>& dispatches, bool json);
// Writes <out>/heatmap-<kind>.png and describes its colors in `said`. Returns what went wrong.
std::string write_heatmap(const Options& options, const Inspection& seen, std::string& said);

}  // namespace northlight
