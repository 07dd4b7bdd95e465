// SPDX-License-Identifier: MIT
// The lists of lights against a sum over all lights, from one light to ten thousand.
#include "effects/assets/built_in/light_forest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "effects/assets/scene/light_constants.h"

namespace kaamos::effects {
namespace {

TEST(LightForest, LightsHaveTheirRangesAndMove) {
  for (const std::uint32_t count : {1u, 100u, 10000u}) {
    Scene scene = make_light_forest({.lights = count});
    ASSERT_TRUE(validate(scene).ok());
    ASSERT_EQ(scene.lights.size(), count);
    std::uint32_t spots = 0;
    for (const Light& light : scene.lights) {
      EXPECT_GE(light.range, 0.5f);
      EXPECT_LE(light.range, 10.0f);
      spots += light.type == LightType::kSpot;
    }
    EXPECT_EQ(spots, count / 3);
    const std::vector<Light> before = scene.lights;
    move_lights(scene, 0.0);
    EXPECT_EQ(scene.lights[0].position, before[0].position);
    move_lights(scene, 0.5);
    ASSERT_TRUE(validate(scene).ok());
    EXPECT_GT(glm::distance(scene.lights[0].position, before[0].position), 0.01);
  }
}

// One in four goes up and down three times a second.
TEST(LightForest, SomeFlicker) {
  Scene scene = make_light_forest({.lights = 16});
  int turns = 0;
  float before = 0, step_before = 0;
  for (int i = 0; i <= 240; ++i) {
    move_lights(scene, i / 240.0);
    const float now = scene.lights[5].intensity, step = now - before;
    turns += i > 1 && step * step_before < 0;
    before = now;
    step_before = step;
  }
  EXPECT_EQ(turns, 6);
  const float steady = scene.lights[4].intensity;
  move_lights(scene, 0.37);
  EXPECT_EQ(scene.lights[4].intensity, steady);
}

}  // namespace
}  // namespace kaamos::effects
