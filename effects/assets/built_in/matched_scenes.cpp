// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/matched_scenes.h"

#include <string>
#include <utility>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/shapes.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

/// So far that no window shows within the scenes: 1 - (d / range)^4 rounds to 1.
constexpr float kNoEnd = 1000.0f;

struct Paint {
  glm::vec3 color;
  float metallic = 0.0f;
  float roughness = 0.0f;
  glm::vec3 emissive{0.0f};
};

Scene empty_scene(const char* name, const glm::dvec3& eye, const glm::dvec3& target, double fov) {
  Scene scene = start_scene(name);
  add_view(scene, name, eye, target, fov);
  return scene;
}

void add(Scene& scene, const char* name, Shape shape, const Paint& paint,
         const glm::dmat4& transform = glm::dmat4(1.0)) {
  MaterialConstants constants;
  constants.base_color = glm::vec4(paint.color, 1.0f);
  constants.metallic = paint.metallic;
  constants.roughness = paint.roughness;
  constants.emissive = paint.emissive;
  constants.flags = kMaterialDoubleSided;
  add_thing(scene, name, std::move(shape), add_material(scene, name, constants), transform);
}

/// The box with its lamp and the tall block.
Scene box_scene(const char* name, const Paint& tall) {
  // A little aside, so that no edge of the box runs through the centres of pixels.
  Scene scene = empty_scene(name, {0.137, 1.083, 4.1}, {0.019, 1.011, 0}, 0.62);
  const Paint white{glm::vec3(0.7f, 0.68f, 0.64f)};
  add(scene, "floor", patch({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 1, 1), white);
  add(scene, "ceiling", patch({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 1, 1), white);
  add(scene, "back", patch({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, 1, 1), white);
  add(scene, "left", patch({-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, 1, 1), {{0.6f, 0.06f, 0.05f}});
  add(scene, "right", patch({1, 0, -1}, {0, 0, 2}, {0, 2, 0}, 1, 1), {{0.1f, 0.42f, 0.09f}});
  add(scene, "tall", box({0.28, 0.6, 0.28}), tall, translate({-0.35, 0.6, -0.35}) * rotate_y(0.32));
  Light lamp;
  lamp.name = "lamp";
  lamp.color = glm::vec3(1.0f, 0.9f, 0.75f);
  lamp.intensity = 4.0f;
  lamp.position = {0.1, 1.6, 0.15};
  lamp.range = kNoEnd;
  lamp.radius = 0.1f;
  scene.lights.push_back(lamp);
  return scene;
}

}  // namespace

Scene make_matched_box() {
  const Paint block{glm::vec3(0.55f, 0.55f, 0.6f)};
  Scene scene = box_scene("matched-box", block);
  add(scene, "short", box({0.3, 0.3, 0.3}), block, translate({0.38, 0.3, 0.3}) * rotate_y(-0.3));
  return scene;
}

Scene make_matched_metal() {
  const glm::vec3 white(1.0f);
  Scene scene = box_scene("matched-metal", {white, 1.0f, 0.3f});
  // Thin, and towards the camera: other renderers mask rough facets otherwise at grazing angles.
  add(scene, "board", box({0.34, 0.4, 0.002}), {white, 1.0f, 0.6f},
      translate({0.42, 0.36, 0.3}) * rotate_y(-0.25) * rotate_x(-0.45));
  return scene;
}

Scene make_matched_yard() {
  Scene scene = empty_scene("matched-yard", {-3.5, 2.6, 6.0}, {0.2, 0.7, 0}, 0.7);
  scene.exposure = 0.35f;
  scene.sky = default_sky();
  scene.sun = default_sun();
  scene.sun->angular_radius = 0.0349f;
  add(scene, "ground", patch({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}, 1, 1), {{0.42f, 0.4f, 0.36f}});
  add(scene, "house", box({0.9, 0.8, 0.6}), {glm::vec3(0.7f, 0.62f, 0.5f)},
      translate({-0.6, 0.8, -0.6}) * rotate_y(0.4));
  add(scene, "wall", box({1.4, 0.45, 0.08}), {glm::vec3(0.5f, 0.2f, 0.16f)},
      translate({1.6, 0.45, 1.3}) * rotate_y(-0.5));
  add(scene, "mirror", patch({1.2, 0.05, -1.6}, {1.5, 0, 0.7}, {0, 1.5, 0}, 1, 1),
      {{0.9f, 0.65f, 0.3f}, 1.0f, 0.0f});
  add(scene, "panel", patch({-2.4, 0.2, 0.3}, {0.5, 0, -0.45}, {0, 0.5, 0}, 1, 1),
      {glm::vec3(0.0f), 0.0f, 0.0f, glm::vec3(6.0f, 3.0f, 1.5f)});
  return scene;
}

}  // namespace kaamos::effects
