// SPDX-License-Identifier: MIT
// Tiles that are classified before rays are traced, against what each class is by itself.
#include "effects/reflections/tiled/tiled_reflections.h"

#include <gtest/gtest.h>

#include <array>

#include "effects/reflections/hybrid/hybrid_reflections.h"
#include "effects/reflections/screen_space/screen_fixture.h"
#include "effects/reflections/screen_space/screen_mask.h"

namespace kaamos::effects {
namespace {

// The stage has no environment map.
TiledConstants under_sky() {
  TiledConstants constants = default_tiled_constants();
  constants.screen.fallback = ScreenFallback::kSky;
  return constants;
}

// Renderers keep a reference.
const Scene& boxes() {
  static const Scene scene = make_screen_boxes();
  return scene;
}

// A mirror for a floor, and things that are as rough as it gets.
std::unique_ptr<FrameRenderer> render(const TiledConstants& constants,
                                      const std::string& backend = "embree") {
  auto renderer =
      make_screen_renderer(backend, boxes(), "tiled-reflections", constants.screen,
                           [&](EffectSettings& settings) { settings.set_constants(constants); });
  renderer->render().value();
  return renderer;
}

class TiledReflections : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, TiledReflections, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// Where everything is traced it is "reflections", bit for bit.
TEST_P(TiledReflections, RaysEverywhereAreReflections) {
  TiledConstants constants = under_sky();
  constants.roughest_screen = -1;
  constants.roughest_traced = 1;
  const auto renderer = render(constants, GetParam());
  EXPECT_EQ(renderer->read("tiled").value().values, renderer->read("reflection").value().values);
}

// With one sample, rays for what the picture leaves in doubt are those of "hybrid-reflections".
TEST_P(TiledReflections, WithoutAnEnvironmentTheyAreHybrid) {
  TiledConstants constants = under_sky();
  constants.roughest_traced = 1;
  const auto renderer = render(constants, GetParam());
  const HybridConstants hybrid = default_hybrid_constants();
  const auto other =
      make_screen_renderer(GetParam(), boxes(), "hybrid-reflections", hybrid.screen,
                           [&](EffectSettings& settings) { settings.set_constants(hybrid); });
  other->render().value();
  EXPECT_EQ(renderer->read("tiled").value().values, other->read("hybrid").value().values);
}

// Without rays and picture it is what a miss of the other techniques shows.
TEST_P(TiledReflections, RoughSurfacesShowTheEnvironment) {
  TiledConstants constants = under_sky();
  constants.roughest_traced = -1;
  const auto renderer = render(constants, GetParam());
  ScreenMaskConstants nothing;
  nothing.screen = constants.screen;
  nothing.roughest = -1;
  const auto other =
      make_screen_renderer(GetParam(), boxes(), "ssr-masked", nothing.screen,
                           [&](EffectSettings& settings) { settings.set_constants(nothing); });
  other->render().value();
  EXPECT_EQ(renderer->read("tiled").value().values, other->read("ssr_masked").value().values);
}

// Only this backend counts rays. There is no sun, so that each is that of a pixel.
TEST(TiledReflectionClasses, RaysGoToTheirPixelsAlone) {
  const auto renderer = render(under_sky());
  const FloatImage classes = renderer->read("tiled_classes").value();
  const FloatImage ids = renderer->read("ids").value();
  const FloatImage material = renderer->read("material").value();
  std::array<std::uint64_t, 4> counts{};
  for (std::uint32_t y = 0; y < classes.height; ++y) {
    for (std::uint32_t x = 0; x < classes.width; ++x) {
      const auto own = static_cast<std::uint32_t>(classes.at(x, y, 0));
      ++counts.at(own);
      ASSERT_EQ(own == 0, ids.at(x, y, 0) == 0) << x << ", " << y;
      // The boxes have roughness 1, the floor 0.
      if (own == 0) continue;
      ASSERT_EQ(own == 1, material.at(x, y, 0) > 0.6f) << x << ", " << y;
      float dearest = 0;
      for (std::uint32_t i = 0; i < 64; ++i) {
        const std::uint32_t u = x / 8 * 8 + i % 8, v = y / 8 * 8 + i / 8;
        if (u < classes.width && v < classes.height) {
          dearest = std::max(dearest, classes.at(u, v, 0));
        }
      }
      ASSERT_EQ(classes.at(x, y, 1), dearest) << x << ", " << y;
    }
  }
  for (const std::uint64_t count : counts) EXPECT_GT(count, 20u);
  const std::uint64_t rays = renderer->run("tiled-reflections", 1).value().rays;
  EXPECT_EQ(rays, counts[3]);
  const std::uint64_t everywhere = renderer->run("reflections", 1).value().rays;
  EXPECT_LT(rays, everywhere * 3 / 4);
}

}  // namespace
}  // namespace kaamos::effects
