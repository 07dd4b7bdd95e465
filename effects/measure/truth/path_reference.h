// SPDX-License-Identifier: MIT
// --reference-path-traced: renders the reference of a scene instead of a frame.
#pragma once

#include "effects/measure/run/frame_result.h"
#include "effects/measure/run/options.h"
#include "effects/measure/truth/ranks.h"
#include "effects/reference/path_reference.h"

namespace kaamos::measure {

// Describes the reference that the options ask for.
effects::PathReferenceDesc describe_reference(const Options& options);

// Writes reference.exr, a PNG for each of its layers, and reference.sums, with which --resume goes
// on. What is done when it is stopped is written too. The ranks share the bands of rows; the first
// one writes, and its `said` becomes what was done.
rtapi::Result<Outcome> render_path_reference(const Options& options, const effects::Scene& scene,
                                             const Ranks& ranks, const Progress& progress,
                                             std::string& said);

}  // namespace kaamos::measure
