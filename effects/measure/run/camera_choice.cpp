// SPDX-License-Identifier: MIT
#include "effects/measure/run/camera_choice.h"

#include <filesystem>

#include "effects/assets/built_in/camera_paths.h"

namespace kaamos::measure {

using namespace kaamos::effects;

effects::Result<CameraPath> choose_path(const Options& options, const Scene& scene) {
  auto built_in = make_camera_path(scene, options.camera_path);
  if (built_in.ok() || !std::filesystem::exists(options.camera_path)) return built_in;
  return load_camera_path(options.camera_path);
}

}  // namespace kaamos::measure
