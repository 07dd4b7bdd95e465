// SPDX-License-Identifier: MIT
/// @file
/// Camera paths by name, for any scene.
#pragma once

#include <string>

#include "effects/assets/scene/camera_path.h"

namespace kaamos::effects {

/// Names of the built-in paths.
inline constexpr const char* kCameraPaths = "still, dolly, orbit, own";

/// A built-in path of 2 seconds from the scene's first camera on: `still`, `dolly` (towards what
/// the camera looks at, a little aside) or `orbit` (about it); in the lounge they stay inside the
/// room. `own` is what some scenes have besides, `pub`, `resort` and `breakfast` one of 20 s. An
/// empty name: the scene's own, else `still` where something moves, else `dolly`.
/// @errors KA3024 another name; the text lists those that there are. `own` of a scene without one.
Result<CameraPath> make_camera_path(const Scene& scene, const std::string& name);

}  // namespace kaamos::effects
