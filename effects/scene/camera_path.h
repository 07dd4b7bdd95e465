// SPDX-License-Identifier: MIT
// Camera paths: positions at certain times, joined by smooth curves.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "effects/common/result.h"
#include "effects/scene/scene.h"

namespace kaamos::effects {

struct CameraKey {
  double seconds = 0.0;
  glm::dvec3 eye{0.0};
  glm::dvec3 target{0.0};
  double vertical_fov = 0.0;  ///< radians; 0: the scene's
  bool cut = false;           ///< the camera jumps here instead of moving
};

/// Before the first key and behind the last the camera stands still.
struct CameraPath {
  std::string name;
  std::vector<CameraKey> keys;  ///< at least one, times rising
};

/// Names of the built-in paths.
inline constexpr const char* kCameraPaths = "still, dolly, orbit";

/// `still`, `dolly` (towards what the camera looks at, a little aside) or `orbit` (about it) from
/// the scene's first camera on, 2 seconds long; in the lounge they stay inside the room. Empty: the
/// scene's own, `still` where something moves, else `dolly`. Error: another name.
Result<CameraPath> make_camera_path(const Scene& scene, const std::string& name);

/// Lines of "seconds eye.x eye.y eye.z target.x target.y target.z [fov=DEGREES] [cut]"; # starts a
/// comment. Errors, with file and line: what is not a number, times that do not rise, an eye in its
/// target, no line at all.
Result<CameraPath> parse_camera_path(std::string_view text, const std::string& name);
Result<CameraPath> load_camera_path(const std::string& file);

/// The camera at a moment: the scene's first camera, moved.
Camera evaluate_camera(const CameraPath& path, const Camera& scene_camera, double seconds);

/// Whether the path cuts after `before` and until `now`: pictures of then say nothing of now.
bool has_cut(const CameraPath& path, double before, double now);

}  // namespace kaamos::effects
