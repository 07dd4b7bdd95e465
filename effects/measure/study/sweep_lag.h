// SPDX-License-Identifier: MIT
// How many frames a filter's history lags behind light that is switched off, or behind something
// that is taken away.
#pragma once

#include <vector>

#include "effects/measure/curves/measure.h"

namespace kaamos::measure {

// What happens in the middle of the sequence.
enum class LagCause {
  kSwitch,  // the sun and all lamps go out
  kMove,    // a box in front of the camera is gone
};

// Frames before it, by which histories are long, and from it on.
inline constexpr std::uint32_t kFramesBefore = 40, kFramesBehind = 48;

// The denoisers of the sweep: accumulation with several weights of the new frame, also with half
// floats, and the whole filters.
std::vector<MeasuredDenoiser> lagging_denoisers();

// Renders indirect light of 1 ray at rest, and adds a row for each denoiser. What is left of the
// change is, over the pixels that it changes, the mean of what is shown, from 100 % before it to 0
// % where it comes to in the end. "energy before": of what is
// shown before over the raw frames. "frames to 10 %": until less is left; "left, 8 frames %" and
// "left, end %". The errors are those of the eighth frame.
rtapi::Result<Outcome> measure_lag(LagCause cause, const Options& options,
                                   const effects::Scene& scene, const Progress& progress,
                                   MeasuredTable& table, const LookAt& look_at);

}  // namespace kaamos::measure
