// SPDX-License-Identifier: MIT
// The light of particles against sums by hand.
#include "effects/particles/particles.h"

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>
#include <memory>
#include <string>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kSide = 65;  // pixels; the middle one's centre is the middle of the picture
constexpr std::size_t kMiddle = kSide * (kSide / 2) + kSide / 2;

// A wall of some radiance 5 m before an orthographic camera that sees 2 m x 2 m of it.
Scene wall_of(float radiance) {
  Scene scene = start_scene("wall");
  MaterialConstants wall;
  wall.base_color = glm::vec4(0, 0, 0, 1);
  wall.emissive = glm::vec3(radiance);
  wall.specular = 0;
  add_box(scene, "wall", {-2, -2, -6}, {2, 2, -5}, add_material(scene, "wall", wall));
  Camera camera;
  camera.half_height = 1;
  scene.cameras.push_back(camera);
  return scene;
}

struct Pictures {
  FloatImage light, radiance;
};

Pictures render(const Scene& scene, const std::string& backend) {
  FrameSettings settings;
  settings.width = settings.height = kSide;
  settings.effects = choose_effects({"particles"});
  settings.denoise.method = DenoiseMethod::kNone;
  rtapi::DeviceDesc device;
  device.Backend = backend;
  const auto renderer = FrameRenderer::create(test::device_for(device), scene, settings).value();
  renderer->render().value();
  return {renderer->read("particles").value(), renderer->read("radiance").value()};
}

class Particles : public test::OnBackends {};
INSTANTIATE_TEST_SUITE_P(Backends, Particles, testing::Values("embree", "vulkan"),
                         [](const auto& each) { return each.param; });

TEST_P(Particles, OneAddsAThirdOfItsAreaTimesItsRadiance) {
  Scene scene = wall_of(0.25f);
  scene.particles.push_back(
      {.position = {0, 0, -3}, .radius = 0.8f, .radiance = {4.0f, 2.0f, 1.0f}});
  const Pictures seen = render(scene, GetParam());
  double sum = 0;
  for (std::size_t i = 0; i < kSide * kSide; ++i) sum += seen.light.values[4 * i];
  const double pixel = 2.0 / kSide, radius = 0.8;
  // The integral of (1 - s^2)^2 over a disk of radius 1 is pi / 3.
  EXPECT_NEAR(sum * pixel * pixel, 4 * radius * radius * glm::pi<double>() / 3, 2e-3);
  EXPECT_NEAR(seen.light.values[4 * kMiddle], 4, 1e-5);
  EXPECT_NEAR(seen.radiance.values[4 * kMiddle + 1], 2.25, 1e-5);
  EXPECT_EQ(seen.light.values[4 * kMiddle + 3], 0) << "it hides nothing";
  EXPECT_EQ(seen.light.values[0], 0) << "the corner is outside of it";
}

TEST_P(Particles, NearOnesHideFarOnesWhateverTheirOrder) {
  const Particle near = {
      .position = {0, 0, -2}, .radius = 0.5f, .radiance = glm::vec3(1), .opacity = 0.75f};
  const Particle far = {
      .position = {0, 0, -4}, .radius = 0.5f, .radiance = glm::vec3(3), .opacity = 0.5f};
  for (const bool near_first : {false, true}) {
    Scene scene = wall_of(8);
    scene.particles =
        near_first ? std::vector<Particle>{near, far} : std::vector<Particle>{far, near};
    const Pictures seen = render(scene, GetParam());
    EXPECT_NEAR(seen.radiance.values[4 * kMiddle], 1 + 0.25 * (3 + 0.5 * 8), 1e-5);
    EXPECT_NEAR(seen.light.values[4 * kMiddle + 3], 1 - 0.25 * 0.5, 1e-6);
  }
}

TEST_P(Particles, WhatIsOpaqueHidesThemAndTheSkyDoesNot) {
  Scene scene = wall_of(0.5f);
  scene.particles.push_back({.position = {0, 0, -5.5}, .radius = 0.5f, .radiance = glm::vec3(9)});
  EXPECT_EQ(render(scene, GetParam()).radiance.values[4 * kMiddle], 0.5f);
  scene.instances.front().transform = translate({0, 50, 0});
  scene.sky = {};
  EXPECT_NEAR(render(scene, GetParam()).radiance.values[4 * kMiddle], 9, 1e-5);
}

}  // namespace
}  // namespace kaamos::effects
