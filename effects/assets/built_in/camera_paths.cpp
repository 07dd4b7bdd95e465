// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/camera_paths.h"

#include <cmath>

#include "effects/assets/built_in/stress_scenes.h"

namespace kaamos::effects {
namespace {

constexpr double kSeconds = 2.0;  // length of the built-in paths
constexpr int kOrbitKeys = 9;

// Distance to what the camera looks at: to the point on its axis closest to the centre of the
// scene, or a step ahead if that point is behind the camera.
double distance_to_subject(const Scene& scene, const Camera& camera) {
  const Bounds bounds = scene_bounds(scene);
  if (bounds.empty()) return 1.0;
  const double along = glm::dot(bounds.center() - camera.position(), camera.forward());
  return along > 0.0 ? along : 0.1 * glm::length(bounds.size()) + 1e-3;
}

std::vector<CameraKey> dolly(const Scene& scene, const Camera& camera) {
  const glm::dvec3 eye = camera.position();
  if (scene.name == "lounge") {
    const glm::dvec3 target(0.3, 1.32, -0.8);
    return {{.seconds = 0.0, .eye = eye, .target = target},
            {.seconds = 1.0, .eye = {-4.95, 1.66, 4.4}, .target = {0.3, 1.27, -0.8}},
            {.seconds = kSeconds, .eye = {-4.3, 1.6, 4.15}, .target = {0.3, 1.2, -0.8}}};
  }
  const double distance = distance_to_subject(scene, camera);
  const glm::dvec3 side(camera.camera_to_world[0]);
  const glm::dvec3 target = eye + distance * camera.forward();
  return {{.seconds = 0.0, .eye = eye, .target = target},
          {.seconds = kSeconds,
           .eye = eye + distance * (0.15 * camera.forward() + 0.06 * side),
           .target = target}};
}

std::vector<CameraKey> orbit(const Scene& scene, const Camera& camera) {
  const bool lounge = scene.name == "lounge";
  const glm::dvec3 eye = camera.position();
  const glm::dvec3 target = lounge ? glm::dvec3(0.3, 1.32, -0.8)
                                   : eye + distance_to_subject(scene, camera) * camera.forward();
  std::vector<CameraKey> out;
  for (int i = 0; i < kOrbitKeys; ++i) {
    const double part = static_cast<double>(i) / (kOrbitKeys - 1);
    // In the lounge, also move towards the table, because the room has walls.
    const double angle = (lounge ? 0.35 : 0.6) * part;
    const double nearer = lounge ? 1.0 - 0.3 * part : 1.0;
    const glm::dvec3 from = eye - target;
    const double c = std::cos(angle), s = std::sin(angle);
    const glm::dvec3 turned(c * from.x + s * from.z, from.y, c * from.z - s * from.x);
    out.push_back({.seconds = kSeconds * part, .eye = target + nearer * turned, .target = target});
  }
  return out;
}

}  // namespace

Result<CameraPath> make_camera_path(const Scene& scene, const std::string& name) {
  const Camera& camera = scene.cameras.front();
  const auto stress = stress_kind(scene);
  if (stress && (name.empty() || name == "own")) return stress_camera_path(*stress);
  CameraPath path;
  path.name = name.empty() ? (scene.animations.empty() ? "dolly" : "still") : name;
  if (name == "own") {
    return make_error(ErrorId::kCameraPath,
                      "scene \"" + scene.name +
                          "\" has no camera path of its own; pub, resort and breakfast have one");
  }
  if (path.name == "still") {
    path.keys = {{.eye = camera.position(), .target = camera.position() + camera.forward()}};
  } else if (path.name == "dolly") {
    path.keys = dolly(scene, camera);
  } else if (path.name == "orbit") {
    path.keys = orbit(scene, camera);
  } else {
    return make_error(ErrorId::kCameraPath, "no camera path \"" + name + "\": there are " +
                                                kCameraPaths + ", and files of positions");
  }
  return path;
}

}  // namespace kaamos::effects
