// SPDX-License-Identifier: MIT
// References: what an effect converges to with many samples, kept in files.
#pragma once

#include <cstdint>
#include <string>

#include "effects/measure/errors/measure_errors.h"
#include "effects/measure/run/effect_runs.h"

namespace kaamos::measure {

// A reference is the mean of this many independent scramblings; the spread between them says how
// far the mean is from the true value.
inline constexpr std::uint32_t kReferenceParts = 4;

// Takes `samples` in total, reusing what a file in `cache` already holds: each part is written when
// it is complete, so an interrupted run continues there. A file is valid as long as a probe with
// few samples gives the same numbers, which detects changes of the scene, of shaders and of
// settings. `name` names the file and shows in the progress. The caller fills in the mask.
rtapi::Result<Outcome> make_reference(EffectRuns& runs, const Setting& setting,
                                      std::uint32_t samples, const std::string& name,
                                      const std::string& cache, const Progress& progress,
                                      Target& target);

// The mean of pictures of equal size, and its standard error over the pixels in the mask.
Target mean_of(const std::vector<effects::FloatImage>& parts,
               const std::vector<std::uint8_t>& mask);

}  // namespace kaamos::measure
