// SPDX-License-Identifier: MIT
// --reference-path-traced: renders the reference of a scene instead of a frame.
#pragma once

#include "effects/reference/path_reference.h"
#include "frame_result.h"
#include "options.h"
#include "ranks.h"

namespace northlight {

// What the options ask of it.
kaamos::effects::PathReferenceDesc describe_reference(const Options& options);

// Writes reference.exr, a PNG for each of its layers, and reference.sums, with which --resume goes
// on. What is done when it is stopped is written too. The ranks share the bands of rows; the first
// one writes.
rtapi::Result<Outcome> render_path_reference(const Options& options,
                                             const kaamos::effects::Scene& scene,
                                             const Ranks& ranks, const Progress& progress,
                                             const Say& message);

}  // namespace northlight
