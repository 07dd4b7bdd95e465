// SPDX-License-Identifier: MIT
// The settings of a plan in motion: along a camera path, past something that moves.
#pragma once

#include "effects/measure/curves/measure.h"

namespace kaamos::measure {

// Renders a few frames of options.camera_path (by default a dolly) with every setting, histories
// carried along. Where nothing moves in the scene, a box does. Each row has its mean error to the
// path-traced truth of each frame, without the first two, and its flicker: the mean change from
// frame to frame beyond motion. The table tells the flicker of the truths themselves.
// options.measure_truth must not be 0.
rtapi::Result<Outcome> run_motion(const MeasurePlan& plan, const Options& options,
                                  const effects::Scene& scene, const Progress& progress,
                                  MeasuredTable& table, const LookAt& look_at);

}  // namespace kaamos::measure
