// SPDX-License-Identifier: MIT
// What the parts would cost that a scene has no use for: each is put back in turn, and the frame
// timed against the one without.
#pragma once

#include <string>

#include "frame_result.h"
#include "options.h"

namespace northlight {

// Renders the scene kRounds times as it is and with each part, in turn, and writes a table: part,
// milliseconds of the frame without and with it (medians), what was saved.
rtapi::Result<Outcome> measure_left_out(const Options& options, const kaamos::effects::Scene& scene,
                                        const Progress& progress, std::string& table);

}  // namespace northlight
