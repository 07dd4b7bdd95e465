// SPDX-License-Identifier: MIT
//
// Tests what must not change a result.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "effect_run.h"
#include "effects/assets/built_in/lounge.h"
#include "effects/assets/built_in/oracle_scenes.h"

namespace kaamos::test {
namespace {

using namespace effects;

TEST(Determinism, ThreadsDoNotChangeAnything) {
  const Scene scene = make_lounge();
  for (const Effect effect : {Effect::kAmbientOcclusion, Effect::kSunShadow}) {
    EffectRun run;
    run.effect = effect;
    run.width = 96;
    run.height = 54;
    run.samples = 4;
    run.threads = 1;
    const EffectResult one = run_effect(scene, run);
    for (const std::uint32_t threads : {2u, 7u}) {
      run.threads = threads;
      const EffectResult more = run_effect(scene, run);
      EXPECT_EQ(one.visibility.values, more.visibility.values) << threads << " threads";
      EXPECT_EQ(one.position.values, more.position.values) << threads << " threads";
    }
  }
}

TEST(Determinism, TheSeedChangesTheNoiseOnly) {
  const Scene scene = make_wall_oracle(10.0);
  EffectRun run;
  run.samples = 16;
  run.radius = 2.0f;
  const EffectResult first = run_effect(scene, run);
  run.seed = 1;
  const EffectResult second = run_effect(scene, run);
  EXPECT_NE(first.visibility.values, second.visibility.values);
  EXPECT_EQ(first.position.values, second.position.values);
}

// Float steps at 100 km are 8 mm. World positions are made relative to the camera in double, so the
// picture is the same there.
TEST(Stability, ASceneFarFromTheOriginLooksTheSame) {
  Scene scene = make_sphere_oracle(0.5, 0.8);
  EffectRun run;
  run.samples = 256;
  const EffectResult near = run_effect(scene, run);
  const glm::dvec3 offset(1e5, 2e3, -3e5);
  for (Instance& instance : scene.instances) instance.transform[3] += glm::dvec4(offset, 0);
  for (Camera& camera : scene.cameras) camera.camera_to_world[3] += glm::dvec4(offset, 0);
  const EffectResult far = run_effect(scene, run);
  double largest = 0;
  for (std::size_t i = 0; i < near.visibility.values.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(near.visibility.values[i]) -
                                         static_cast<double>(far.visibility.values[i])));
  }
  std::printf("largest difference at 3e5 m: %.2e\n", largest);
  EXPECT_LE(largest, 1.0 / 256);  // one ray of a pixel
}

}  // namespace
}  // namespace kaamos::test
