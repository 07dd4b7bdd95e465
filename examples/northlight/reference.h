// SPDX-License-Identifier: MIT
// northlight --reference N: what each effect converges to, beside what it rendered.
#pragma once

#include "frame_result.h"
#include "options.h"

namespace northlight {

// The options of the reference frame: N samples of each effect, nothing denoised, each layer of
// glass in its order.
Options reference_options(const Options& options);

// Renders that frame and adds its layers to `result` as NAME_reference: of each effect that
// `result` has, and the whole as radiance_reference.
rtapi::Result<Outcome> add_reference(const Options& options, const kaamos::effects::Scene& scene,
                                     const Progress& progress, const Say& message,
                                     FrameResult& result);

}  // namespace northlight
