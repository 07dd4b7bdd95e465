// SPDX-License-Identifier: MIT
// Far from the origin and on large scales: the sun's shadow is that of rays in double precision,
// and the offset of the scene changes nothing.
#include "effects/assets/built_in/terrain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/assets/scene/host_rays_test_support.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 48, kHeight = 27;

FloatImage sun_of(const Scene& scene) {
  rtapi::Device device = rtapi::CreateDevice().value();
  FrameSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.effects = choose_effects({"sun"});
  settings.whole_frame = false;
  auto renderer = FrameRenderer::create(device, scene, settings).value();
  renderer->render().value();
  return renderer->read("sun").value();
}

TEST(Terrain, IsTheSameAnywhere) {
  const FloatImage here = sun_of(make_terrain({}));
  for (const double away : {1e3, 1e6}) {
    const FloatImage there = sun_of(make_terrain({.offset = {away, 0, -2 * away}}));
    EXPECT_EQ(here.values, there.values) << away;
  }
}

// Both cameras: at a tower of a millimetre's foot, and over ten kilometres. No lit surface is dark
// (acne) and no dark one lit, but beside the edges of shadows.
TEST(Terrain, HasNoAcne) {
  for (const std::size_t view : {std::size_t{0}, std::size_t{1}}) {
    Scene scene = make_terrain({});
    scene.cameras.front() = scene.cameras[view];
    const FloatImage sun = sun_of(scene);
    const HostRays rays(scene);
    const Camera& camera = scene.cameras.front();
    const glm::dvec3 to_sun(scene.sun->direction_to_sun);
    const double up = std::tan(0.5 * camera.vertical_fov), right = up * kWidth / kHeight;
    int lit = 0, dark = 0, wrong = 0;
    for (std::uint32_t i = 0; i < kWidth * kHeight; i += 3) {
      const double x = 2.0 * (i % kWidth + 0.5) / kWidth - 1.0;
      const double y = 1.0 - 2.0 * (i / kWidth + 0.5) / kHeight;
      const glm::dvec3 way(camera.camera_to_world * glm::dvec4(x * right, y * up, -1.0, 0.0));
      const auto surface = rays.nearest(camera.position(), way);
      if (!surface) continue;
      // Backed off by a millionth of the distance, so that the surface does not hide itself.
      const glm::dvec3 at = camera.position() + way * (surface->t * (1.0 - 1e-6));
      const bool sees = !rays.nearest(at, to_sun).has_value();
      (sees ? lit : dark) += 1;
      wrong += (sun.values[i] > 0.5f) != sees;
    }
    EXPECT_GT(lit, 40) << view;
    EXPECT_GT(dark, 4) << view;
    EXPECT_LE(wrong, 1) << view;
  }
}

}  // namespace
}  // namespace kaamos::effects
