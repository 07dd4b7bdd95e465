// SPDX-License-Identifier: MIT
// northlight --claims: what the talk, the deck and the survey say of costs, beside what is measured
// here on each backend.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/image/csv.h"
#include "frame_result.h"
#include "options.h"

namespace northlight {

// One claim: a ratio of two costs, or a share of a sum of costs.
struct Claim {
  std::string text;
  std::string seed;  // as it stands there
  // By backend; none where the scene or the machine has no case for it.
  std::vector<std::optional<double>> here;
};

struct ClaimTable {
  std::vector<std::string> backends;  // name and size
  std::vector<Claim> claims;
};

std::string as_text(const ClaimTable& table);
kaamos::effects::Table as_csv(const ClaimTable& table);

// On Embree, and, a quarter as wide and high, on Vulkan where the machine has it: medians over
// options.repeats of ratios within one round. Where the scene lacks what a claim is about, it has
// no number.
rtapi::Result<Outcome> measure_claims(const Options& options, const kaamos::effects::Scene& scene,
                                      const Progress& progress, ClaimTable& table);

// Measures, prints, and writes claims.csv into options.out.
rtapi::Result<Outcome> run_claims(const Options& options, const kaamos::effects::Scene& scene,
                                  const Progress& progress);

}  // namespace northlight
