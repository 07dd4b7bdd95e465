// SPDX-License-Identifier: MIT
// Planar reflections and ray traced mirrors, each the other's oracle.
#include "effects/reflections/planar/planar_reflections.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/assets/built_in/mirror_hall.h"
#include "effects/reflections/screen_space/screen_fixture.h"
#include "tests/vulkan/support.h"

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
  const auto renderer = FrameRenderer::create(test::device_for(device), hall, settings).value();
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

// A polished floor of one mesh with a wall that shines, and blocks that stand and hang.
Scene make_polished_room(float roughness) {
  Scene scene = make_mirror_floor();
  scene.materials.front().constants.roughness = roughness;
  add_shining_box(scene, {3, 2, 0.1}, {0, 2, -3}, {0.2f, 0.3f, 0.9f});
  add_shining_box(scene, {0.3, 0.8, 0.3}, {-1, 0.8, 0}, {1, 0.2f, 0.1f});
  add_shining_box(scene, {0.3, 0.3, 0.3}, {1.2, 1.6, -1}, {0.2f, 1, 0.2f});
  return scene;
}

struct Planar {
  FloatImage planar, traced, ids;
};

Planar render(const std::string& backend, const Scene& scene, const PlanarConstants& constants) {
  FrameSettings settings;
  settings.width = 64;
  settings.height = 36;
  settings.effects = choose_effects({"planar", "reflections"});
  ReflectionConstants rays;
  rays.length_jitter = 0;
  rays.single_length = 1;
  settings.effects.at("reflections").set_constants(rays).samples = 64;
  settings.effects.at("planar").set_constants(constants);
  settings.denoise.method = DenoiseMethod::kNone;
  settings.volume.given = std::make_shared<IndirectVolume>();
  rtapi::DeviceDesc device;
  device.Backend = backend;
  const auto renderer = FrameRenderer::create(test::device_for(device), scene, settings).value();
  renderer->render().value();
  return {renderer->read("planar").value(), renderer->read("reflection").value(),
          renderer->read("ids").value()};
}

// Over pixels of one instance, as shown.
double decibels_on(const FloatImage& a, const FloatImage& b, const FloatImage& ids, float id) {
  double squares = 0;
  int values = 0;
  for (std::uint32_t y = 0; y < a.height; ++y) {
    for (std::uint32_t x = 0; x < a.width; ++x) {
      if (ids.at(x, y, 0) != id) continue;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const auto shown = [](double v) { return v / (1 + v); };
        const double d = shown(a.at(x, y, c)) - shown(b.at(x, y, c));
        squares += d * d;
        ++values;
      }
    }
  }
  EXPECT_GT(values, 300);
  return -10 * std::log10(squares / values);
}

// What touches a rough floor is sharp and what is far away blurred, as by rays.
TEST_P(PlanarReflections, RoughFloorsAreBlurredByDistance) {
  for (const float roughness : {0.1f, 0.25f, 0.4f}) {
    const Planar seen = render(GetParam(), make_polished_room(roughness), {});
    EXPECT_GT(decibels_on(seen.planar, seen.traced, seen.ids, 1), 28) << roughness;
  }
}

TEST_P(PlanarReflections, DrawsShowWhatRaysShow) {
  const PlanarConstants drawn{.source = PlanarSource::kDraws};
  for (const float roughness : {0.0f, 0.25f}) {
    const Scene room = make_polished_room(roughness);
    const Planar by_rays = render(GetParam(), room, {});
    const Planar by_draws = render(GetParam(), room, drawn);
    EXPECT_GT(decibels_on(by_draws.planar, by_rays.planar, by_rays.ids, 1), 50) << roughness;
  }
}

// The hall's rods are thinner than a pixel: rounding decides which of them a draw covers.
TEST_P(PlanarReflections, DrawsShowWhatRaysShowOfThinRods) {
  const PlanarConstants drawn{.source = PlanarSource::kDraws};
  const Scene hall = make_mirror_hall();
  const FloatImage by_rays = render(GetParam(), hall, {}).planar;
  const FloatImage by_draws = render(GetParam(), hall, drawn).planar;
  int off = 0;
  for (std::uint32_t y = 0; y < by_rays.height; ++y) {
    for (std::uint32_t x = 0; x < by_rays.width; ++x) {
      const double a = by_rays.at(x, y, 0), b = by_draws.at(x, y, 0);
      off += std::abs(a - b) > 0.01 * (1 + a) ? 1 : 0;
    }
  }
  EXPECT_LE(off, 12) << "of 2304 pixels";
}

TEST(MirrorPlanes, AnyFlatSurfaceThatMirrorsCountsBySmoothness) {
  const Scene hall = make_mirror_hall();
  const auto planes = find_mirror_planes(hall);
  ASSERT_EQ(planes.size(), 4u) << "the mirrors, and both sides of the strip";
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(std::abs(planes[i].normal.x), 1, 1e-9);
    EXPECT_NEAR(std::abs(planes[i].point.x), kMirrorHallHalfWidth, 1e-6);
    EXPECT_NEAR(planes[i].area, 36, 1e-5);  // 12 m x 3 m
    EXPECT_TRUE(planes[i].is_mirror);
  }
  EXPECT_FALSE(planes[2].is_mirror);
  Scene twice = hall;
  twice.instances.push_back(hall.instances.front());
  EXPECT_NEAR(find_mirror_planes(twice).front().area, 72, 1e-5);
  Scene matte = hall;
  for (Material& material : matte.materials) material.constants.roughness = 0.6f;
  EXPECT_TRUE(find_mirror_planes(matte).empty());
  Scene small = hall;
  for (Instance& instance : small.instances) {
    instance.transform = glm::dmat4(glm::dmat3(0x1p-20)) * instance.transform;
  }
  glm::dmat4& eye = small.cameras.front().camera_to_world;
  eye[3] = glm::dvec4(glm::dvec3(eye[3]) * 0x1p-20, 1);
  const auto near = find_mirror_planes(small);
  ASSERT_EQ(near.size(), planes.size()) << "a few micrometres apart";
  for (std::size_t i = 0; i < near.size(); ++i) EXPECT_EQ(near[i].point, planes[i].point * 0x1p-20);
}

// The sides of a box are planes, though the box is not flat.
TEST(MirrorPlanes, SidesOfOneMeshAreFound) {
  Scene scene = make_mirror_floor();
  scene.instances.clear();
  add_shining_box(scene, {2, 1, 0.5}, {0, 1, 0}, glm::vec3(0));
  scene.materials.back().constants.roughness = 0.2f;
  const auto planes = find_mirror_planes(scene);
  ASSERT_EQ(planes.size(), PlanarConstants{}.most_planes);
  EXPECT_NEAR(planes[0].area, 8, 1e-5);
  EXPECT_NEAR(std::abs(planes[0].normal.z), 1, 1e-9);
  EXPECT_NEAR(planes[2].area, 4, 1e-5);
  EXPECT_NEAR(std::abs(planes[2].normal.y), 1, 1e-9);
}

TEST(MirrorPlanes, TheSettingsSayHowManyAndHowRough) {
  const Scene hall = make_mirror_hall();
  EXPECT_EQ(find_mirror_planes(hall, {.most_planes = 1}).size(), 1u);
  EXPECT_TRUE(find_mirror_planes(hall, {.most_planes = 0}).empty());
  const Scene rough = make_polished_room(0.6f);
  EXPECT_TRUE(find_mirror_planes(rough).empty());
  EXPECT_FALSE(find_mirror_planes(rough, {.roughest = 0.7f}).empty());
}

INSTANTIATE_TEST_SUITE_P(Backends, PlanarReflections, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
