// SPDX-License-Identifier: MIT
// What the parts that a scene does not need would cost: each is put back in turn, and the frame is
// timed against the one without it.
#pragma once

#include <atomic>
#include <string>

#include "renderer.h"

namespace northlight {

// Renders the scene kRounds times as it is and with each part, in turn, and returns a table: the
// part, the frame's milliseconds without and with it (medians), and the saving. An error with an
// empty id means that `stop` was set.
rtapi::Result<std::string> measure_left_out(const Options& options,
                                            const kaamos::effects::Scene& scene,
                                            const ShaderLibraries& libraries,
                                            const Progress& progress,
                                            const std::atomic<bool>& stop);

}  // namespace northlight
