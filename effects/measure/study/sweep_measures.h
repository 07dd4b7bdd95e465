// SPDX-License-Identifier: MIT
// What the rows of sweeps tell besides their error. [MeasurePlan::also]
#pragma once

#include "effects/measure/curves/measure.h"

namespace kaamos::measure {

// Of visibility against that of a point, which is 0 or 1: "acne %" of what is lit is dark, and
// "gap %" of what is dark is lit.
rtapi::Result<Also> acne_and_gap(EffectRuns& runs, const MeasuredSetting& measured,
                                 const effects::FloatImage& image, const Target& target);

// "mean" of the compared pixels, and "mean of rays" of what they are compared with.
rtapi::Result<Also> means(EffectRuns& runs, const MeasuredSetting& measured,
                          const effects::FloatImage& image, const Target& target);

// Of a march over the picture, % of its rays: "coverage" hit; "right hits" and "false hits" against
// what the rays hit in the scene; "missed" what the picture shows; "rightly none".
rtapi::Result<Also> hits_and_misses(EffectRuns& runs, const MeasuredSetting& measured,
                                    const effects::FloatImage& image, const Target& target);

}  // namespace kaamos::measure
