// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/oracle_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/shapes.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

constexpr double kPi = glm::pi<double>();

Scene empty_scene(const char* name) {
  Scene scene;
  scene.name = name;
  Material white;
  white.name = "white";
  white.constants.base_color = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
  white.constants.flags = kMaterialDoubleSided;
  scene.materials.push_back(white);
  scene.samplers.push_back(Sampler{});
  scene.sky = default_sky();
  scene.sun = default_sun();
  return scene;
}

void add(Scene& scene, const char* name, Shape shape, const glm::dvec3& at = glm::dvec3(0.0),
         std::uint32_t material = 0) {
  add_thing(scene, name, std::move(shape), material, translate(at));
}

void add_camera(Scene& scene, const glm::dvec3& eye, const glm::dvec3& target) {
  Camera camera;
  camera.name = scene.name;
  camera.camera_to_world = look_at(eye, target);
  scene.cameras.push_back(camera);
}

/// A flat rectangle facing +y.
Shape floor(double x0, double x1, double half_z) {
  return patch({x0, 0, half_z}, {x1 - x0, 0, 0}, {0, 0, -2.0 * half_z}, 1, 1);
}

Shape sphere(double radius, int segments, int rings) {
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= rings; ++i) {
    const double angle = -0.5 * kPi + kPi * i / rings;
    profile.emplace_back(i == 0 || i == rings ? 0.0 : radius * std::cos(angle),
                         radius * std::sin(angle));
  }
  return revolve(profile, segments);
}

double clamped_acos(double x) {
  return std::acos(std::clamp(x, -1.0, 1.0));
}

}  // namespace

Scene make_sphere_oracle(double radius, double height) {
  Scene scene = empty_scene("sphere-oracle");
  add(scene, "plane", floor(-100.0 * height, 100.0 * height, 100.0 * height));
  // 512 x 256 faces are at most 2e-5 radii inside the sphere, far below the noise of 4096 rays.
  add(scene, "sphere", sphere(radius, 512, 256), {0, height, 0});
  add_camera(scene, {0, 4.0 * height, 5.0 * height}, {0, 0.3 * height, 0});
  return scene;
}

double sphere_occlusion(double radius, double height, double x) {
  return radius * radius * height / std::pow(height * height + x * x, 1.5);
}

Scene make_wall_oracle(double height) {
  Scene scene = empty_scene("wall-oracle");
  // The missing ends of the wall cover x h^2 / (3 pi z^3) of the hemisphere, below 1e-6. A longer
  // wall would be worse because its upper edge is rounded: one of 4 km is off by 1.7e-4.
  const double half_z = 50.0 * height;
  add(scene, "plane", floor(0.0, 100.0 * height, half_z));
  // Faces +x.
  add(scene, "wall", patch({0, 0, half_z}, {0, 0, -2.0 * half_z}, {0, height, 0}, 1, 1));
  add_camera(scene, {3.0 * height, 2.5 * height, 0.0}, {0.8 * height, 0, 0});
  return scene;
}

double wall_occlusion(double height, double x) {
  return 0.5 * (1.0 - x / std::hypot(x, height));
}

double wall_occlusion_bounded(double length, double x) {
  const double c = std::min(1.0, x / length);
  return (clamped_acos(c) - c * std::sqrt(1.0 - c * c)) / kPi;
}

Scene make_penumbra_oracle(double height, double angular_radius) {
  Scene scene = empty_scene("penumbra-oracle");
  const double size = 100.0 * height;
  add(scene, "plane", floor(-size, size, size));
  add(scene, "edge", floor(-size, 0.0, size), {0, height, 0});
  scene.sun->direction_to_sun = glm::vec3(0, 1, 0);
  scene.sun->angular_radius = static_cast<float>(angular_radius);
  // Seen from the lit side and from below the sheet, so that the sheet does not hide the edge of
  // its shadow.
  add_camera(scene, {2.0 * height, 0.8 * height, 0}, {0, 0, 0});
  return scene;
}

Scene make_oracle_box() {
  Scene scene = empty_scene("oracle-box");
  Material mirror;
  mirror.name = "mirror";
  mirror.constants = {
      .base_color = glm::vec4(0.95f, 0.95f, 0.95f, 1), .metallic = 1, .roughness = 0};
  scene.materials.push_back(mirror);
  add(scene, "plane", floor(-100.0, 100.0, 100.0));
  add(scene, "sphere", sphere(0.5, 64, 32), {0, 0.6, 0});
  add(scene, "wall 1", box({0.05, 0.5, 1.0}), {-2.0, 0.5, 0});
  add(scene, "wall 3", box({1.5, 1.5, 0.05}), {-0.5, 1.5, -2.5});
  add(scene, "sheet", box({0.8, 0.005, 0.6}), {1.9, 1.0, 1.0});
  add(scene, "mirror", box({0.02, 0.8, 0.7}), {2.6, 0.8, -1.2}, 1);
  Light lamp;
  lamp.name = "disk";
  lamp.position = {1.6, 2.0, 1.0};
  lamp.intensity = 3.0f;
  lamp.radius = 0.2f;
  scene.lights.push_back(lamp);
  add_camera(scene, {0.6, 2.4, 5.0}, {0.2, 0.6, 0});
  return scene;
}

double penumbra_visibility(double height, double angular_radius, double x) {
  const double s = std::clamp(x / (height * std::tan(angular_radius)), -1.0, 1.0);
  return (clamped_acos(-s) + s * std::sqrt(1.0 - s * s)) / kPi;
}

}  // namespace kaamos::effects
