// SPDX-License-Identifier: MIT
// Ways to make a frame that no effect has for itself: traced pixels, antialiasing.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "effects/measure/curves/measure.h"

namespace kaamos::measure {

// A way to make the frame.
struct FrameWay {
  std::string technique, label;
  std::string option;  // of northlight; empty: as frames are by default
  std::function<void(Options& options)> change = [](Options&) {};
  bool in_sequences = false;  // frames of a sequence alone can take it
  bool traces_less = false;   // than the plain one
};

// Those of the family "upscaling" or "antialiasing", the plain one first; none: any other family.
const std::vector<FrameWay>& frame_ways(const std::string& family);

// Measures whole frames of all effects by rays, denoised, with the camera at rest: the last of a
// sequence. Held against a frame of many samples that traces every pixel, and for antialiasing
// against the mean of many points of each pixel; errors are those of what is seen. `look_at` as of
// run_plan.
rtapi::Result<Outcome> measure_frame_ways(const std::string& family, const Options& options,
                                          const effects::Scene& scene, const Progress& progress,
                                          MeasuredTable& table, const LookAt& look_at = {});

}  // namespace kaamos::measure
