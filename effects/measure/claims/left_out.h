// SPDX-License-Identifier: MIT
// Measures what the parts that a scene does not need would cost: each is put back in turn, and the
// frame is timed against the one without it.
#pragma once

#include <string>

#include "effects/measure/run/frame_result.h"
#include "effects/measure/run/options.h"

namespace kaamos::measure {

// Renders the scene kRounds times as it is and with each part, in turn, and makes a table: the
// part, the frame's milliseconds without and with it (medians), and the saving.
rtapi::Result<Outcome> measure_left_out(const Options& options, const effects::Scene& scene,
                                        const Progress& progress, std::string& table);

}  // namespace kaamos::measure
