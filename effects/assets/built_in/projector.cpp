// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/projector.h"

#include <cmath>
#include <string>
#include <utility>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kTexels = 256;

// `color` of the place in the slide, x and y from -1 to 1, y down.
template <typename Color>
TextureImage slide(const char* name, Color color) {
  TextureImage image;
  image.name = name;
  image.width = image.height = kTexels;
  image.mips.emplace_back(std::size_t{kTexels} * kTexels * 4);
  for (std::uint32_t y = 0; y < kTexels; ++y) {
    for (std::uint32_t x = 0; x < kTexels; ++x) {
      const glm::vec3 c = color((2.0 * x + 1.0) / kTexels - 1.0, (2.0 * y + 1.0) / kTexels - 1.0);
      std::uint8_t* out = &image.mips[0][(std::size_t{y} * kTexels + x) * 4];
      for (int i = 0; i < 3; ++i) out[i] = static_cast<std::uint8_t>(255.0f * c[i] + 0.5f);
      out[3] = 255;
    }
  }
  return image;
}

// A window of two by two panes behind blinds.
glm::vec3 blinds(double x, double y) {
  const bool outside = std::abs(x) > 0.6 || std::abs(y) > 0.65;
  const bool bar = std::abs(x) < 0.03 || std::abs(y) < 0.03;
  const bool slat = std::fmod((y + 1.0) * 12.0, 1.0) < 0.35;
  return outside || bar || slat ? glm::vec3(0.0f) : glm::vec3(1.0f, 0.9f, 0.75f);
}

// A rose of eight panes in lead.
glm::vec3 rose(double x, double y) {
  const double radius = std::sqrt(x * x + y * y);
  const double turn = (std::atan2(y, x) / (2 * 3.14159265358979) + 0.5) * 8.0;
  const double from_lead = std::abs(turn - std::round(turn)) * radius;
  if (radius > 0.65 || std::abs(radius - 0.28) < 0.02 || (radius > 0.28 && from_lead < 0.025))
    return glm::vec3(0.0f);
  if (radius < 0.28) return {1.0f, 0.85f, 0.3f};
  constexpr glm::vec3 kGlass[] = {{0.9f, 0.1f, 0.1f}, {0.1f, 0.25f, 0.9f}, {0.1f, 0.7f, 0.2f}};
  return kGlass[static_cast<int>(turn) % 8 % 3];
}

Light spot(const char* name, std::uint32_t image, const glm::dvec3& position,
           const glm::dvec3& target, float half_angle) {
  Light light;
  light.name = name;
  light.type = LightType::kSpot;
  light.position = position;
  light.direction = glm::vec3(glm::normalize(target - position));
  light.outer_cone_angle = half_angle;
  light.inner_cone_angle = 0.98f * half_angle;
  light.range = 20.0f;
  light.radius = 0.01f;
  light.projection = ProjectionMap{.image = image, .sampler = 0};
  return light;
}

}  // namespace

Scene make_projector() {
  Scene scene;
  scene.name = "projector";
  scene.samplers.push_back({.wrap_u = Wrap::kClamp, .wrap_v = Wrap::kClamp, .mipmapped = false});
  scene.images.push_back(slide("blinds", blinds));
  scene.images.push_back(slide("rose", rose));
  const std::uint32_t wall = add_paint(scene, "wall", glm::vec3(0.7f), 0.9f);
  const std::uint32_t floor = add_paint(scene, "floor", glm::vec3(0.25f), 0.15f);
  const std::uint32_t wood = add_paint(scene, "wood", {0.45f, 0.28f, 0.15f}, 0.5f);
  add_thing(scene, "floor", patch({-3, 0, 2.5}, {6, 0, 0}, {0, 0, -5}, 1, 1), floor);
  add_thing(scene, "ceiling", patch({-3, 3, -2.5}, {6, 0, 0}, {0, 0, 5}, 1, 1), wall);
  add_thing(scene, "back wall", patch({-3, 0, -2.5}, {6, 0, 0}, {0, 3, 0}, 1, 1), wall);
  add_thing(scene, "left wall", patch({-3, 0, 2.5}, {0, 0, -5}, {0, 3, 0}, 1, 1), wall);
  add_thing(scene, "right wall", patch({3, 0, -2.5}, {0, 0, 5}, {0, 3, 0}, 1, 1), wall);
  add_thing(scene, "front wall", patch({3, 0, 2.5}, {-6, 0, 0}, {0, 3, 0}, 1, 1), wall);
  add_thing(scene, "table top", box({0.8, 0.03, 0.4}), wood, translate({-0.3, 0.75, -1.2}));
  for (const double x : {-1.0, 0.4}) {
    for (const double z : {-1.5, -0.9}) {
      add_thing(scene, "table leg", box({0.03, 0.36, 0.03}), wood, translate({x, 0.36, z}));
    }
  }
  add_thing(scene, "vase", box({0.08, 0.2, 0.08}), wall, translate({-0.5, 0.98, -1.2}));

  Light blind = spot("window", 0, {2.6, 2.4, 1.8}, {-0.9, 1.1, -2.3}, 0.42f);
  blind.intensity = 160.0f;
  Light glass = spot("stained glass", 1, {1.6, 2.9, -0.2}, {1.4, 0.0, -0.4}, 0.42f);
  glass.intensity = 40.0f;
  glass.projection->up = {0, 0, -1};
  scene.lights = {blind, glass};
  scene.exposure = 0.3f;

  Camera camera;
  camera.name = "door";
  camera.camera_to_world = look_at({-0.4, 1.6, 2.3}, {0.1, 0.9, -1.6});
  camera.vertical_fov = 1.05;
  scene.cameras.push_back(camera);
  return scene;
}

}  // namespace kaamos::effects
