// SPDX-License-Identifier: MIT
// What the parts would cost that a scene has no use for: each is put back in turn, and the frame
// timed against the one without.
#pragma once

#include <atomic>
#include <string>

#include "renderer.h"

namespace northlight {

// Renders the scene kRounds times as it is and with each part, in turn, and returns a table: part,
// milliseconds of the frame without and with it (medians), what was saved. An empty error id:
// `stop` was set.
rtapi::Result<std::string> measure_left_out(const Options& options,
                                            const kaamos::effects::Scene& scene,
                                            const ShaderLibraries& libraries,
                                            const Progress& progress,
                                            const std::atomic<bool>& stop);

}  // namespace northlight
