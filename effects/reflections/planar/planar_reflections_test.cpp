// SPDX-License-Identifier: MIT
// Planar reflections and ray traced mirrors, each the other's oracle.
#include "effects/reflections/planar/planar_reflections.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/assets/built_in/mirror_hall.h"
#include "effects/reflections/screen_space/screen_fixture.h"

namespace kaamos::effects {
namespace {

class PlanarReflections : public test::OnBackends {};

// A plane mirrors exactly; at full resolution only resampling differs: at least 40 dB.
TEST_P(PlanarReflections, MirrorsInAPlaneAreThoseOfRays) {
  const Scene hall = make_mirror_hall();
  FrameSettings settings;
  settings.width = 64;
  settings.height = 36;
  settings.effects = choose_effects({"planar", "reflections"});
  ReflectionConstants rays;
  rays.length_jitter = 0;
  settings.effects.at("reflections").set_constants(rays);
  PlanarConstants planar;
  planar.fallback = 0;
  settings.effects.at("planar").set_constants(planar);
  settings.denoise.method = DenoiseMethod::kNone;
  settings.volume.given = std::make_shared<IndirectVolume>();
  rtapi::DeviceDesc device;
  device.Backend = GetParam();
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice(device).value(), hall, settings).value();
  renderer->render().value();
  const FloatImage plane = renderer->read("planar").value();
  const FloatImage traced = renderer->read("reflection").value();
  const FloatImage ids = renderer->read("ids").value();
  double squares = 0;
  int values = 0;
  for (std::uint32_t y = 0; y < plane.height; ++y) {
    for (std::uint32_t x = 0; x < plane.width; ++x) {
      // The left and the right mirror; nothing else lies in their planes.
      if (ids.at(x, y, 0) != 1.0f && ids.at(x, y, 0) != 2.0f) continue;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const auto shown = [](double v) { return v / (1 + v); };
        const double d = shown(plane.at(x, y, c)) - shown(traced.at(x, y, c));
        squares += d * d;
        ++values;
      }
    }
  }
  ASSERT_GT(values, 900);
  EXPECT_GT(-10 * std::log10(squares / values), 40);
}

TEST(MirrorPlanes, FlatMirrorsAreFoundAndShareTheirPlane) {
  const Scene hall = make_mirror_hall();
  const auto planes = find_mirror_planes(hall);
  ASSERT_EQ(planes.size(), 2u);
  for (const MirrorPlane& plane : planes) {
    EXPECT_NEAR(std::abs(plane.normal.x), 1, 1e-9);
    EXPECT_NEAR(std::abs(plane.point.x), kMirrorHallHalfWidth, 1e-6);
    EXPECT_NEAR(plane.area, 36, 1e-6);  // 12 m x 3 m
  }
  Scene twice = hall;
  twice.instances.push_back(hall.instances.front());
  EXPECT_EQ(find_mirror_planes(twice).size(), 2u);
  Scene none = hall;
  for (Material& material : none.materials) material.constants.roughness = 0.5f;
  EXPECT_TRUE(find_mirror_planes(none).empty());
  Scene small = hall;
  for (Instance& instance : small.instances) {
    instance.transform = glm::dmat4(glm::dmat3(0x1p-20)) * instance.transform;
  }
  EXPECT_EQ(find_mirror_planes(small).size(), 2u) << "a few micrometres apart";
}

INSTANTIATE_TEST_SUITE_P(Backends, PlanarReflections, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
