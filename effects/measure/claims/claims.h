// SPDX-License-Identifier: MIT
// northlight --claims: what the talk, the deck and the survey say about costs, beside what is
// measured here on each backend.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/assets/image/csv.h"
#include "effects/measure/run/frame_result.h"
#include "effects/measure/run/options.h"

namespace kaamos::measure {

// One claim: a ratio of two costs, or a share of a sum of costs.
struct Claim {
  std::string text;
  std::string seed;  // the source's own wording
  // By backend; empty if the scene or the machine has no case for it.
  std::vector<std::optional<double>> here;
};

// A pass of the survey's Table 1, in milliseconds.
struct ControlPass {
  std::string name;
  double frames[2];                         // Control's
  std::vector<std::optional<double>> here;  // by backend, as above
  bool is_build = false;  // of acceleration structures, which the table's sums leave out
};

// A pass as it is timed here.
struct TimedPass {
  double ms = 0;
  double rays = 0;  // of pixels, without those that hits send
};

// A number of the deck: milliseconds of a pass at 1920 x 1080 on an RTX 2080 Ti.
struct DeckNumber {
  std::string name;
  double ms = 0;
  double rays = 0;                             // per pixel
  std::string compare;                         // what the two numbers have in common, and what not
  std::vector<std::optional<TimedPass>> here;  // by backend
};

struct ClaimTable {
  std::vector<std::string> backends;  // name and picture size
  std::vector<double> pixels;         // of their pictures
  std::vector<Claim> claims;
  std::vector<ControlPass> control;
  std::vector<DeckNumber> deck;
};

// Pixels of the deck's picture.
inline constexpr double kDeckPixels = 1920.0 * 1080.0;

std::string as_text(const ClaimTable& table);
effects::Table as_csv(const ClaimTable& table);

// Measures on Embree and, if the machine has it, on Vulkan at a quarter of the width and height.
// The numbers are medians over options.repeats rounds of ratios within a round; a claim about
// something that the scene lacks has no number.
rtapi::Result<Outcome> measure_claims(const Options& options, const effects::Scene& scene,
                                      const Progress& progress, ClaimTable& table);

// Measures, and writes claims.csv and the page claims.md into options.out; `said` becomes the table
// as text.
rtapi::Result<Outcome> run_claims(const Options& options, const effects::Scene& scene,
                                  const Progress& progress, std::string& said);

}  // namespace kaamos::measure
