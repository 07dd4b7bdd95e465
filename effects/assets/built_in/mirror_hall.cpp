// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/mirror_hall.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <utility>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects {
namespace {

constexpr double kLength = 12.0, kHeight = 3.0;  // metres
constexpr double kFieldOfView = 0.9;

struct Paint {
  glm::vec3 color;
  float metallic = 0.0f;
  float roughness = 0.7f;
  glm::vec3 emissive{0.0f};
};

void add(Scene& scene, const std::string& name, Shape shape, const Paint& paint,
         const glm::dvec3& at = glm::dvec3(0.0)) {
  MaterialConstants constants;
  constants.base_color = glm::vec4(paint.color, 1.0f);
  constants.metallic = paint.metallic;
  constants.roughness = paint.roughness;
  constants.emissive = paint.emissive;
  add_thing(scene, name, std::move(shape), add_material(scene, name, constants), translate(at));
}

void add_room(Scene& scene) {
  const double x = kMirrorHallHalfWidth, z = 0.5 * kLength;
  const Paint mirror{glm::vec3(0.95f), 1.0f, 0.0f};
  add(scene, "mirror left", patch({-x, 0, z}, {0, 0, -2 * z}, {0, kHeight, 0}, 1, 1), mirror);
  add(scene, "mirror right", patch({x, 0, -z}, {0, 0, 2 * z}, {0, kHeight, 0}, 1, 1), mirror);
  add(scene, "floor", patch({-x, 0, z}, {2 * x, 0, 0}, {0, 0, -2 * z}, 1, 1),
      {glm::vec3(0.35f, 0.33f, 0.3f)});
  add(scene, "ceiling", patch({-x, kHeight, -z}, {2 * x, 0, 0}, {0, 0, 2 * z}, 1, 1),
      {glm::vec3(0.7f)});
  add(scene, "far wall", patch({-x, 0, -z}, {2 * x, 0, 0}, {0, kHeight, 0}, 1, 1),
      {glm::vec3(0.3f, 0.4f, 0.6f)});
  add(scene, "near wall", patch({x, 0, z}, {-2 * x, 0, 0}, {0, kHeight, 0}, 1, 1),
      {glm::vec3(0.6f, 0.4f, 0.3f)});
}

void add_strip(Scene& scene) {
  const double width = 3.0 / kMirrorHallSteps;
  for (int i = 0; i < kMirrorHallSteps; ++i) {
    const float roughness = static_cast<float>(i) / (kMirrorHallSteps - 1);
    add(scene, "strip " + std::to_string(i), box({0.5 * width, 0.01, 0.6}),
        {glm::vec3(0.9f), 1.0f, roughness}, {-1.5 + width * (i + 0.5), 0.011, 0.5});
  }
}

void add_hidden_props(Scene& scene) {
  const glm::vec3 colors[] = {{0.8f, 0.1f, 0.1f}, {0.1f, 0.7f, 0.2f}, {0.1f, 0.2f, 0.9f}};
  for (int i = 0; i < 3; ++i) {
    add(scene, "behind " + std::to_string(i), box({0.25, 0.5, 0.25}), {colors[i]},
        {-1.2 + 1.2 * i, 0.5, 5.0});
    add(scene, "above " + std::to_string(i), box({0.2, 0.2, 0.2}), {colors[2 - i]},
        {-1.2 + 1.2 * i, kHeight - 0.3, 2.2});
  }
}

// Rods that are one pixel wide at their distance, in a picture of 720 rows.
void add_rods(Scene& scene, double camera_z) {
  for (int i = 0; i < 5; ++i) {
    const double z = -1.5 - 0.5 * i;
    const double pixel = 2.0 * std::tan(0.5 * kFieldOfView) / 720.0 * (camera_z - z);
    add(scene, "rod " + std::to_string(i), box({0.5 * pixel, 0.75, 0.5 * pixel}),
        {glm::vec3(0.9f, 0.8f, 0.2f), 0.0f, 0.5f}, {-1.0 + 0.5 * i, 0.75, z});
  }
}

void add_bulb(Scene& scene) {
  const glm::dvec3 at(0.6, 2.1, -2.0);
  const double radius = 0.03;
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= 12; ++i) {
    const double angle = glm::pi<double>() * (i / 12.0 - 0.5);
    profile.emplace_back(i == 0 || i == 12 ? 0.0 : radius * std::cos(angle),
                         radius * std::sin(angle));
  }
  add(scene, "bulb", revolve(profile, 24), {glm::vec3(0.0f), 0.0f, 1.0f, glm::vec3(1e4f)}, at);
  scene.instances.back().mask = kMaskEmissiveProxy;
  // The light that such a bulb gives: its radiance times the area of its visible disk.
  Light light;
  light.name = "bulb";
  light.intensity = static_cast<float>(1e4 * glm::pi<double>() * radius * radius);
  light.position = at;
  light.radius = static_cast<float>(radius);
  scene.lights.push_back(light);
}

}  // namespace

Scene make_mirror_hall() {
  Scene scene;
  scene.name = "mirror-hall";
  scene.samplers.push_back(Sampler{});
  scene.exposure = 0.35f;
  const glm::dvec3 eye(0.3, 1.5, 3.6);
  add_room(scene);
  add_strip(scene);
  add_hidden_props(scene);
  add_rods(scene, eye.z);
  add_bulb(scene);
  Camera camera;
  camera.name = scene.name;
  camera.camera_to_world = look_at(eye, {-0.3, 0.8, -1.0});
  camera.vertical_fov = kFieldOfView;
  scene.cameras.push_back(camera);
  return scene;
}

}  // namespace kaamos::effects
