// SPDX-License-Identifier: MIT
// The path-traced truth that --measure holds effects and frames against.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "effects/measure/errors/measure_errors.h"
#include "effects/measure/run/frame_result.h"
#include "effects/measure/run/options.h"
#include "effects/reference/path_sums.h"

namespace kaamos::measure {

// Traces options.measure_truth samples a pixel of the scene's first camera, at options.seconds, or
// takes a committed reference of at least as many.
// What is done is kept in `cache`, so that an interrupted measurement goes on there.
rtapi::Result<Outcome> trace_truth(const Options& options, const effects::Scene& scene,
                                   const std::string& cache, const Progress& progress,
                                   effects::PathSums& sums);

// A picture made of layers of the truth, with the standard error that its two halves tell. `make`
// takes the means of the named layers, a pixel's values one after the other, and writes
// `channels` values; returning false leaves the pixel out.
using MakePixel =
    std::function<bool(std::size_t pixel, const std::vector<const float*>& layers, float* out)>;
Target truth_picture(const effects::PathSums& sums, const std::vector<std::string>& layers,
                     std::uint32_t channels, const MakePixel& make);

}  // namespace kaamos::measure
