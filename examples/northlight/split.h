// SPDX-License-Identifier: MIT
// northlight --split: settings side by side in one picture, as the talk shows them.
#pragma once

#include <string>
#include <vector>

#include "effects/image/image.h"
#include "effects/scene/scene.h"
#include "frame_result.h"
#include "options.h"

namespace northlight {

// ao: 1, 4 and 16 rays per pixel. gi: the volume at the surface times ambient occlusion, against
// gathering with rays. near-field: hits taken as black against lit hits. denoise: the whole frame
// at one ray per pixel, raw against denoised.
const std::vector<std::string>& split_names();

// Strips of equal width from pictures of equal size: strip i from picture i, with a thin line
// between.
kaamos::effects::ByteImage side_by_side(const std::vector<kaamos::effects::ByteImage>& pictures);

// Renders what options.split names and writes split-NAME.png into options.out.
rtapi::Result<Outcome> run_split(const Options& options, const kaamos::effects::Scene& scene,
                                 const Progress& progress, const Say& message);

}  // namespace northlight
