// SPDX-License-Identifier: MIT
// --quality and --budget: techniques that are chosen from what was measured.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "options.h"

namespace northlight {

// The values of options that are words, kept until all options have been read.
struct QualityWords {
  std::string quality;
  std::string budget;
};

void add_quality(CLI::App& app, Options& options, QualityWords& words);
// Returns an error, or nothing.
std::string apply_quality_words(const QualityWords& words, Options& options);

// Chooses the techniques of the frame, measuring them first where nobody has. `said` becomes what
// was chosen, and why.
rtapi::Result<Outcome> choose_techniques(Options& options, const kaamos::effects::Scene& scene,
                                         const Progress& progress, std::string& said);

}  // namespace northlight
