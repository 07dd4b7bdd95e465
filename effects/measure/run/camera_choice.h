// SPDX-License-Identifier: MIT
// The camera path of a run.
#pragma once

#include "effects/assets/scene/camera_path.h"
#include "effects/assets/scene/scene.h"
#include "effects/measure/run/options.h"

namespace kaamos::measure {

// That of options.camera_path: a built-in one or a file's.
effects::Result<effects::CameraPath> choose_path(const Options& options,
                                                 const effects::Scene& scene);

}  // namespace kaamos::measure
