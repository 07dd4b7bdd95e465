// SPDX-License-Identifier: MIT
// Stochastic reflections: what neighbours' rays are good for.
#include "effects/reflections/stochastic/stochastic_reflections.h"

#include <gtest/gtest.h>

#include "effects/reflections/screen_space/screen_fixture.h"

namespace kaamos::effects {
namespace {

class StochasticReflections : public test::OnBackends {};

std::unique_ptr<FrameRenderer> renderer_of(const std::string& backend, const Scene& scene,
                                           const std::string& effect,
                                           const StochasticConstants& constants) {
  return make_screen_renderer(backend, scene, effect, constants.screen,
                              [&](EffectSettings& settings) {
                                if (effect == "ssr") settings.set_constants(constants.screen);
                                if (effect != "ssr") settings.set_constants(constants);
                              });
}

StochasticConstants with_sky() {
  StochasticConstants constants;
  constants.screen.fallback = ScreenFallback::kSky;
  return constants;
}

// Whatever the weights are, the mean of one value is that value.
TEST_P(StochasticReflections, AUniformSkyComesBackExactly) {
  Scene scene = make_mirror_floor();
  scene.materials.front().constants.roughness = 0.5f;
  const auto renderer = renderer_of(GetParam(), scene, "ssr-stochastic", with_sky());
  renderer->render().value();
  const FloatImage seen = renderer->read("ssr_stochastic").value();
  const FloatImage ids = renderer->read("ids").value();
  int pixels = 0, dark = 0;
  for (std::uint32_t y = 0; y < seen.height; ++y) {
    for (std::uint32_t x = 0; x < seen.width; ++x) {
      if (ids.at(x, y, 0) == 0) continue;
      ++pixels;
      if (seen.at(x, y, 0) == 0) {
        ++dark;  // all neighbours' rays are below the surface
      } else {
        ASSERT_NEAR(seen.at(x, y, 0), 0.25f, 1e-5f);
      }
    }
  }
  EXPECT_GT(pixels, 500);
  EXPECT_LT(dark, pixels / 50);
}

TEST(StochasticReflectionsNoise, NeighboursTakeMoreNoiseThanTheyBringBias) {
  Scene scene = make_screen_boxes();
  scene.materials.front().constants.roughness = 0.4f;
  const auto march = renderer_of("embree", scene, "ssr", with_sky());
  march->render().value();
  march->run("ssr", 256).value();
  const FloatImage truth = march->read("ssr").value();
  march->run("ssr", 1).value();
  const double alone = rmse_of(march->read("ssr").value(), truth);
  const auto shared = renderer_of("embree", scene, "ssr-stochastic", with_sky());
  shared->render().value();
  // For a quarter of the marches.
  const double together = rmse_of(shared->read("ssr_stochastic").value(), truth);
  EXPECT_LT(together, 0.6 * alone);
}

INSTANTIATE_TEST_SUITE_P(Backends, StochasticReflections, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
