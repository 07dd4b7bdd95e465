// SPDX-License-Identifier: MIT
// Drawn glass against glass that rays see, layer by layer. [Control; survey 6.5]
#include "effects/glass/drawn_glass/drawn_glass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/assets/built_in/glass_scenes.h"
#include "effects/assets/built_in/scene_parts.h"
#include "effects/glass/drawn_glass/glass_fixture.h"
#include "effects/reflections/environment_map/probe_places.h"

namespace kaamos::effects {
namespace {

// Two panes before a dark wall, and behind the camera a bright one with a dark half, which the
// panes mirror.
Scene two_panes() {
  const Pane panes[] = {{.distance = 1.0, .alpha = 0.2f}, {.distance = 1.5, .alpha = 0.2f}};
  Scene scene = make_pane_oracle(panes, glm::vec3(0.0f));
  add_paint(scene, "bright", glm::vec3(0.0f));
  scene.materials.back().constants.emissive = glm::vec3(4.0f);
  add_box(scene, "bright", {-6, -4, 5}, {0, 4, 5.1},
          static_cast<std::uint32_t>(scene.materials.size() - 1));
  return scene;
}

class DrawnGlasses : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, DrawnGlasses, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// With nothing in place of other reflections it is the same as rays of which the first alone
// reflects; and if no depth fits, as rays that do not reflect at all.
TEST_P(DrawnGlasses, TheNearestLayerAloneHasATracedMirrorImage) {
  GlassFrame frame(two_panes(), GetParam(), 48, 27, DrawnGlassFallback::kNothing);
  const FloatImage first = frame.traced(1), none = frame.traced(0);
  ASSERT_GT(difference(first, none), 0.5) << "reflections can be told from none";
  EXPECT_LT(difference(first, frame.drawn(DrawnGlassFallback::kNothing)), 1e-3);
  const FloatImage missed = frame.drawn(DrawnGlassFallback::kNothing, -1.0f);
  for (std::size_t i = 0; i < missed.values.size(); ++i) {
    if (i % 4 != 3) {
      ASSERT_NEAR(missed.values[i], none.values[i], 1e-5) << i;
    }
  }
}

// Two panes of paint under a sun that shines over the camera's head. A board keeps it off the
// nearer one, and off the lower half of the farther one.
Scene half_shaded_panes() {
  const Pane panes[] = {{.distance = 1.0, .alpha = 0.3f, .base_color = {0.9f, 0.2f, 0.1f}},
                        {.distance = 1.5, .alpha = 0.6f, .base_color = {0.1f, 0.3f, 0.9f}}};
  Scene scene = make_pane_oracle(panes, glm::vec3(0.0f));
  scene.sun = Sun{.direction_to_sun = glm::normalize(glm::vec3(0, 1, 1)), .angular_radius = 0};
  add_box(scene, "board", {-6, 0.5, 0}, {6, 1.57, 0.05}, 0);
  return scene;
}

// Each layer has a ray of its own to the sun: with the nearest one's for all the farther pane would
// be dark.
TEST_P(DrawnGlasses, EachLayerSeesTheSunForItself) {
  GlassFrame frame(half_shaded_panes(), GetParam(), 48, 27, DrawnGlassFallback::kNothing);
  const FloatImage traced = frame.traced(0);
  // A layer without a mirror image lets as much through as those of the rays.
  const FloatImage drawn = frame.drawn(
      {.rays = {.full_reflection = 0}, .tolerance = -1, .fallback = DrawnGlassFallback::kNothing});
  EXPECT_GT(traced.at(24, 4, 2), 0.05f) << "above, the sun is on the farther pane";
  EXPECT_LT(traced.at(24, 22, 2), 1e-3f) << "below, it is on none";
  EXPECT_LT(difference(traced, drawn), 1e-4);
}

// Two panes that cross in the middle of the picture. Their boxes have one centre, so that all of
// the second is drawn over the first. Where it is behind it, the picture is off by the product of
// both coverages times the difference of both colours, and nowhere else. [Porter & Duff 1984]
TEST_P(DrawnGlasses, PanesThatCrossAreWrongOnOneSide) {
  const Pane first = {.distance = 3, .alpha = 0.5f, .emissive = {4, 0, 1}, .turned = 0.5};
  const Pane second = {.distance = 3, .alpha = 0.25f, .emissive = {0, 2, 8}, .turned = -0.5};
  const Pane panes[] = {first, second};
  GlassFrame frame(make_pane_oracle(panes, glm::vec3(0.0f)), GetParam(), 48, 27,
                   DrawnGlassFallback::kNothing);
  const FloatImage sorted = frame.traced(0);
  const FloatImage drawn = frame.drawn(
      {.rays = {.full_reflection = 0}, .tolerance = -1, .fallback = DrawnGlassFallback::kNothing});
  for (const std::uint32_t y : {2u, 13u, 24u}) {
    // The first is nearer on the left.
    for (std::uint32_t c = 0; c < 3; ++c) {
      const int i = static_cast<int>(c);
      const float off = first.alpha * second.alpha * (second.emissive[i] - first.emissive[i]);
      EXPECT_NEAR(drawn.at(4, y, c), sorted.at(4, y, c) + off, 1e-5) << y << " " << c;
      EXPECT_NEAR(drawn.at(43, y, c), sorted.at(43, y, c), 1e-5) << y << " " << c;
    }
  }
}

// All that bright panes in the dark mirror is the wall, which an environment map from near the
// panes has as well: with it the second layer is nearer to what rays find than without.
TEST(DrawnGlass, TheEnvironmentStandsInForFurtherLayers) {
  Scene scene = two_panes();
  scene.probes = {camera_probe(scene)};
  GlassFrame frame(scene);
  const FloatImage all = frame.traced(2);
  const double nothing = difference(all, frame.drawn(DrawnGlassFallback::kNothing));
  const double environment = difference(all, frame.drawn(DrawnGlassFallback::kEnvironment));
  EXPECT_GT(nothing, 0.05);
  EXPECT_LT(environment, 0.7 * nothing);
}

// Layers are blended by where they are, not by the order in which the scene names them.
TEST(DrawnGlass, TheOrderOfInstancesDoesNotCount) {
  Scene scene = two_panes();
  GlassFrame first(scene, "embree", 48, 27, DrawnGlassFallback::kNothing);
  std::reverse(scene.instances.begin(), scene.instances.end());
  GlassFrame second(scene, "embree", 48, 27, DrawnGlassFallback::kNothing);
  const FloatImage a = first.drawn(DrawnGlassFallback::kNothing);
  EXPECT_GT(difference(a, FloatImage(a.width, a.height, a.channels)), 0.5);
  EXPECT_LT(difference(a, second.drawn(DrawnGlassFallback::kNothing)), 1e-5);
}

TEST(DrawnGlass, NoGlassAndOnePixelAreFine) {
  GlassFrame bare(make_pane_oracle({}, glm::vec3(0.5f)), "embree", 16, 9);
  for (const float value : bare.drawn(DrawnGlassFallback::kEnvironment).values) {
    EXPECT_EQ(value, 0.0f);
  }
  GlassFrame pixel(two_panes(), "embree", 1, 1);
  for (const float value : pixel.drawn(DrawnGlassFallback::kEnvironment).values) {
    EXPECT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace kaamos::effects
