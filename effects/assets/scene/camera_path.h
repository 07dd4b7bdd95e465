// SPDX-License-Identifier: MIT
/// @file
/// Camera paths: positions at certain times, joined by smooth curves.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The camera's place and view at one moment.
struct CameraKey {
  double seconds = 0.0;       ///< from the start of the sequence
  glm::dvec3 eye{0.0};        ///< world space, metres
  glm::dvec3 target{0.0};     ///< what it looks at: world space, not the eye
  double vertical_fov = 0.0;  ///< radians; 0: the scene's
  bool cut = false;           ///< the camera jumps here instead of moving
};

/// Before the first key and behind the last the camera stands still.
struct CameraPath {
  std::string name;             ///< for people
  std::vector<CameraKey> keys;  ///< at least one, times rising
};

/// Reads lines of "seconds eye.x eye.y eye.z target.x target.y target.z [fov=DEGREES] [cut]",
/// metres in world space; what follows a number sign is a comment. `name` stands for the file in
/// messages.
/// @errors KA3024, with file and line: what is not a number, times that do not rise, an eye in its
/// target, no line at all.
Result<CameraPath> parse_camera_path(std::string_view text, const std::string& name);
/// The same from a file.
/// @errors those of read_file and of parse_camera_path.
Result<CameraPath> load_camera_path(const std::string& file);

/// The scene's first camera, moved to where the path is at `seconds`: a smooth curve through the
/// keys.
Camera evaluate_camera(const CameraPath& path, const Camera& scene_camera, double seconds);

/// Returns whether the path cuts after `before` and until `now`, seconds: then what earlier frames
/// saw does not help.
bool has_cut(const CameraPath& path, double before, double now);

}  // namespace kaamos::effects
