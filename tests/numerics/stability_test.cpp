// SPDX-License-Identifier: MIT
//
// What must not change a result, and how fast more samples make it better.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "effect_run.h"
#include "effects/scene/lounge.h"
#include "effects/scene/oracle_scenes.h"

namespace kaamos::test {
namespace {

using namespace effects;

double root_mean_square_error(const EffectRun& run, const Scene& scene) {
  const double origin = scene.cameras.front().position().x;
  const EffectResult result = run_effect(scene, run);
  double sum = 0;
  double count = 0;
  for (std::uint32_t i = 0; i < run.width * run.height; ++i) {
    if (result.ids.values[i * 2] != 1) continue;
    const double x = origin + result.position.values[i * 4];
    const double error = result.visibility.values[i] - (1 - wall_occlusion_bounded(2.0, x));
    sum += error * error;
    ++count;
  }
  return std::sqrt(sum / count);
}

// Random samples give -0.5; Owen-scrambled Sobol points over an edge about -0.75.
// [effects-spec B0.3]
TEST(Sampling, ErrorFallsFasterThanOfRandomSamples) {
  const Scene scene = make_wall_oracle(10.0);
  EffectRun run;
  run.radius = 2.0f;
  run.width = 48;
  run.height = 32;
  run.samples = 4;
  const double few = root_mean_square_error(run, scene);
  run.samples = 256;
  const double many = root_mean_square_error(run, scene);
  const double slope = std::log(many / few) / std::log(256.0 / 4.0);
  std::printf("RMSE at 4 rays %.4f, at 256 rays %.5f: slope %.2f\n", few, many, slope);
  EXPECT_LT(slope, -0.62);
}

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

// A float has 8 mm steps at 100 km. World positions are relative to the camera in double, so the
// picture is the same there. [effects-spec B0.1]
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

// Without an epsilon, and far too small and far too large for one.
TEST(Stability, NoSelfOcclusionAtAnyScale) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    Scene scene = make_sphere_oracle(0.5 * scale, 0.8 * scale);
    // The plane alone is open everywhere.
    scene.instances.resize(1);
    scene.meshes.resize(1);
    EffectRun run;
    run.samples = 64;
    run.radius = static_cast<float>(4 * scale);
    const EffectResult result = run_effect(scene, run);
    std::uint32_t closed = 0;
    std::uint32_t seen = 0;
    for (std::size_t i = 0; i < result.visibility.values.size(); ++i) {
      if (result.ids.values[i * 2] != 1) continue;
      ++seen;
      closed += result.visibility.values[i] < 1 ? 1 : 0;
    }
    EXPECT_GT(seen, 0u);
    EXPECT_EQ(closed, 0u) << "of " << seen << " pixels at scale " << scale;
  }
}

}  // namespace
}  // namespace kaamos::test
