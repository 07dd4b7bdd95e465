// SPDX-License-Identifier: MIT
// Hybrid reflections: which rays they save, and what that costs.
#include "effects/reflections/hybrid/hybrid_reflections.h"

#include <gtest/gtest.h>

#include "effects/reflections/screen_space/screen_fixture.h"

namespace kaamos::effects {
namespace {

class HybridReflections : public test::OnBackends {};

// Only this backend counts rays.
TEST(HybridReflectionsRays, RaysAreTracedWhereThePictureLeavesADoubt) {
  const Scene scene = make_screen_boxes();
  const HybridConstants constants = default_hybrid_constants();
  const auto renderer =
      make_screen_renderer("embree", scene, "hybrid-reflections", constants.screen,
                           [&](EffectSettings& settings) { settings.set_constants(constants); });
  renderer->render().value();
  const std::uint64_t rays = renderer->run("hybrid-reflections", 1).value().rays;
  const HitComparison found = compare(*renderer, "hybrid", constants.screen);
  // There is no sun, so that each traced ray is one of a march that found nothing.
  EXPECT_EQ(rays, found.confusion.rays() - found.confusion.hits());
  EXPECT_GT(found.confusion.hits(), found.confusion.rays() / 20) << "some rays are saved";
  // The hits that are taken from the picture are right.
  EXPECT_GT(found.confusion.correct(), 0.97 * static_cast<double>(found.confusion.hits()));
}

TEST_P(HybridReflections, ThePictureIsNearerToThatOfRaysThanAMarchs) {
  const Scene scene = make_screen_boxes();
  const auto error = [&](const std::string& effect, const std::string& signal,
                         const ScreenReflectionConstants& screen,
                         const std::function<void(EffectSettings&)>& change) {
    const auto renderer = make_screen_renderer(GetParam(), scene, effect, screen, change);
    renderer->render().value();
    return rmse_of(renderer->read(signal).value(), renderer->read("reflection").value());
  };
  const HybridConstants hybrid = default_hybrid_constants();
  ScreenReflectionConstants march = march_of_pixels();
  march.fallback = ScreenFallback::kSky;
  const double by_march = error("ssr", "ssr", march, [&](auto& s) { s.set_constants(march); });
  const double by_both = error("hybrid-reflections", "hybrid", hybrid.screen,
                               [&](auto& s) { s.set_constants(hybrid); });
  EXPECT_LT(by_both, 0.5 * by_march);
}

INSTANTIATE_TEST_SUITE_P(Backends, HybridReflections, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
