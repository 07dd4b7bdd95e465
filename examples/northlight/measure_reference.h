// SPDX-License-Identifier: MIT
// References: what an effect converges to, by many samples, kept in files.
#pragma once

#include <cstdint>
#include <string>

#include "effect_runs.h"
#include "measure_errors.h"

namespace northlight {

// Independent scramblings that a reference is the mean of: from how they differ follows how far the
// mean is from the truth.
inline constexpr std::uint32_t kReferenceParts = 4;

// Takes `samples` in all, or what a file in `cache` holds of them: each part is written when it is
// complete, so an interrupted run goes on where it was. A file counts as long as a probe with few
// samples gives the same numbers: a change of the scene, of a shader or of a setting is seen.
// `name`: of the file, and for the progress. The mask is left to the caller.
rtapi::Result<Outcome> make_reference(EffectRuns& runs, const Setting& setting,
                                      std::uint32_t samples, const std::string& name,
                                      const std::string& cache, const Progress& progress,
                                      Target& target);

// The mean of pictures of equal size, and its standard error over the pixels that count.
Target mean_of(const std::vector<kaamos::effects::FloatImage>& parts,
               const std::vector<std::uint8_t>& mask);

}  // namespace northlight
