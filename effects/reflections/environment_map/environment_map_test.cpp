// SPDX-License-Identifier: MIT
// Environment maps against known answers.
#include "effects/reflections/environment_map/environment_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "effects/reflections/environment_map/probe_places.h"
#include "effects/reflections/screen_space/screen_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

class EnvironmentMaps : public test::OnBackends {};

std::unique_ptr<FrameRenderer> render(const std::string& backend, const Scene& scene) {
  FrameSettings settings;
  settings.width = 48;
  settings.height = 32;
  settings.effects = choose_effects({"env-map", "reflections"});
  settings.denoise.method = DenoiseMethod::kNone;
  settings.volume.given = std::make_shared<IndirectVolume>();
  rtapi::DeviceDesc device;
  device.Backend = backend;
  auto renderer = FrameRenderer::create(test::device_for(device), scene, settings).value();
  renderer->render().value();
  return renderer;
}

// The floor shines as the sky does, so that the same light comes from everywhere.
TEST(EnvironmentMapLevels, UniformLightStaysWhatItIsOnEveryLevel) {
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    Scene scene = make_mirror_floor();
    MaterialConstants& floor = scene.materials.front().constants;
    floor.base_color = glm::vec4(0, 0, 0, 1);
    floor.metallic = 0;
    floor.roughness = roughness;
    floor.emissive = glm::vec3(0.25f);
    scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::vec3(0.25f);
    const auto renderer = render("embree", scene);
    const FloatImage seen = renderer->read("env_map").value();
    const FloatImage ids = renderer->read("ids").value();
    int pixels = 0;
    for (std::uint32_t y = 0; y < seen.height; ++y) {
      for (std::uint32_t x = 0; x < seen.width; ++x) {
        if (ids.at(x, y, 0) == 0) continue;
        ++pixels;
        // A floor that shines 0.25 and mirrors at most all of a sky of 0.25 lies between these.
        ASSERT_GE(seen.at(x, y, 0), 0.2499f) << x << ", " << y << ", roughness " << roughness;
        ASSERT_LE(seen.at(x, y, 0), 0.501f) << x << ", " << y << ", roughness " << roughness;
      }
    }
    EXPECT_GT(pixels, 100);
  }
}

// A room whose walls shine each in its own colour, and are those of the probe's box: a mirror on
// the floor shows the same walls as by rays, away from their edges.
TEST_P(EnvironmentMaps, WallsOfTheBoxAreWhereTheyAre) {
  Scene scene = make_mirror_floor();
  scene.instances.clear();
  add_shining_patch(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, glm::vec3(0));
  scene.materials.back() = scene.materials.front();  // the floor is the mirror
  add_shining_patch(scene, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, {1, 0, 0});
  add_shining_patch(scene, {-2, 0, 2}, {0, 0, -4}, {0, 3, 0}, {0, 1, 0});
  add_shining_patch(scene, {2, 0, -2}, {0, 0, 4}, {0, 3, 0}, {0, 0, 1});
  add_shining_patch(scene, {2, 0, 2}, {-4, 0, 0}, {0, 3, 0}, {1, 1, 0});
  add_shining_patch(scene, {-2, 3, -2}, {4, 0, 0}, {0, 0, 4}, {0, 1, 1});
  scene.cameras.front().camera_to_world = look_at(glm::dvec3(0.6, 2, 1.6), glm::dvec3(-0.5, 0, -1));
  const auto renderer = render(GetParam(), scene);
  const FloatImage seen = renderer->read("env_map").value();
  const FloatImage rays = renderer->read("reflection").value();
  const FloatImage ids = renderer->read("ids").value();
  int pixels = 0, alike = 0;
  for (std::uint32_t y = 0; y < seen.height; ++y) {
    for (std::uint32_t x = 0; x < seen.width; ++x) {
      if (ids.at(x, y, 0) != 1.0f) continue;
      ++pixels;
      float worst = 0;
      for (std::uint32_t c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(seen.at(x, y, c) - rays.at(x, y, c)));
      }
      alike += worst < 0.1f ? 1 : 0;
    }
  }
  ASSERT_GT(pixels, 300);
  EXPECT_GT(alike, 0.9 * pixels) << "of " << pixels;
}

TEST(EnvironmentMapSettings, WrongProbesAreRefused) {
  const Scene scene = make_mirror_floor();
  const EnvironmentProbe probe = camera_probe(scene);
  EXPECT_NE(check_environment({.probes = {}}).error().message.find("KA3070"), std::string::npos);
  EXPECT_FALSE(check_environment({.probes = {probe}, .side = 48}).ok());
  EXPECT_FALSE(check_environment({.probes = {probe}, .rays = 0}).ok());
  EnvironmentProbe flat = probe;
  flat.box_max.y = flat.box_min.y;
  EXPECT_FALSE(check_environment({.probes = {flat}}).ok());
  flat = probe;
  flat.position.x = std::nan("");
  EXPECT_FALSE(check_environment({.probes = {flat}}).ok());
  EXPECT_TRUE(check_environment({.probes = {probe}}).ok());
}

INSTANTIATE_TEST_SUITE_P(Backends, EnvironmentMaps, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
