// SPDX-License-Identifier: MIT
// northlight --reference N: what each effect converges to, beside what it rendered.
#pragma once

#include "effects/measure/run/frame_result.h"
#include "effects/measure/run/options.h"

namespace kaamos::measure {

// The options of the reference frame: N samples for each effect, no denoising, each layer of glass
// in order.
Options reference_options(const Options& options);

// Renders that frame and adds its layers to `result` as NAME_reference, one for each effect in
// `result`, and the whole frame as radiance_reference.
rtapi::Result<Outcome> add_reference(const Options& options, const effects::Scene& scene,
                                     const Progress& progress, FrameResult& result);

}  // namespace kaamos::measure
