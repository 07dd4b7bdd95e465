// SPDX-License-Identifier: MIT
// The results of --study for a family, kept in files so that an interrupted study goes on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/assets/image/csv.h"
#include "effects/assets/image/pareto.h"
#include "effects/assets/image/plot.h"

namespace kaamos::measure {

// Stands in StudyRow::note where two settings give one picture and no effect says why
// [Effect::may_equal]: a fault of the study or of the technique.
inline constexpr const char* kUnexplained = "no reason is known";

// A setting of a technique.
struct StudyRow {
  std::string effect;  // of the registry; empty: a denoiser
  std::string technique, label;
  std::string command;   // that measures this row alone
  std::string missing;   // why it was not measured; empty: it was
  std::string note;      // what else must be known to read the numbers; may be empty
  double ms = 0;         // median
  double fixed_ms = 0;   // of it, what does not grow with the picture; 0: that was not measured
  double ms_spread = 0;  // (longest - shortest) / median
  double traced = 0;     // rays per pixel
  double error = 0;      // RMSE against the truth
  double flip = 0, ssim = 0, energy = 0;
  double flicker = -1;  // mean change from frame to frame beyond motion; negative: not measured
  std::vector<std::pair<std::string, double>> also;  // what else a sweep tells, by name
  std::string picture;                               // PNG files beside the report
  std::string difference;  // 4 times its absolute difference from the truth
};

struct StudyResult {
  std::string family, title;  // "shadows-motion", "Shadows of the sun, in motion"
  std::string key;            // of all that it depends on
  std::string scene, backend;
  std::uint32_t width = 0, height = 0;  // pixels
  std::string subtitle;                 // scene, size, backend, repeats
  std::string signal;                   // what is compared
  std::string truth;                    // what it is compared with
  std::string truth_picture;            // a PNG file
  double truth_error = 0;               // the truth's own standard error
  std::vector<std::string> about;
  std::vector<StudyRow> rows;

  // Returns a trade for each row. Rows that were not measured get NaN, which no front takes.
  std::vector<effects::Trade> trades() const;
  bool is_measured() const;  // at least one row is
};

std::string to_json(const std::vector<StudyResult>& results);
// Nothing where the text is no list of results.
std::optional<std::vector<StudyResult>> parse_results(const std::string& text);

effects::Table as_csv(const std::vector<StudyResult>& results);
// Time against error; marks have the row's number as their key.
effects::Plot as_plot(const StudyResult& result);

}  // namespace kaamos::measure
