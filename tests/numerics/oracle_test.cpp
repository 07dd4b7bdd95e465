// SPDX-License-Identifier: MIT
//
// Effects against closed forms: 4,096 rays per pixel and 16 scrambles, or 16,384 and 64 with
// KAAMOS_FULL=1. The error of a pixel's mean over the scrambles is estimated from their spread. The
// true value must lie within five such errors of it, and so must the mean over all pixels, whose
// error is much smaller.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "effect_run.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "size.h"

namespace kaamos::test {
namespace {

using namespace effects;

const std::uint32_t kScrambles = by_size(16, 16, 64);
const std::uint32_t kRays = by_size(256, 4096, 16384);
// Positions and directions are floats: an edge is off by some 1e-7 of the scene's size, which a
// penumbra magnifies.
constexpr double kFloatBound = 1e-4;

struct Statistics {
  double sum = 0;
  double sum_of_squares = 0;
  void add(double v) {
    sum += v;
    sum_of_squares += v * v;
  }
  double mean() const { return sum / kScrambles; }
  // The standard error of the mean.
  double standard_error() const {
    const double variance = std::max(0.0, sum_of_squares / kScrambles - mean() * mean()) *
                            kScrambles / (kScrambles - 1);
    return std::sqrt(variance / kScrambles);
  }
};

// Compares every pixel that sees the plane with `truth` at its x.
void expect_matches(const Scene& scene, EffectRun run,
                    const std::function<double(const glm::dvec3&)>& truth) {
  const glm::dvec3 origin = scene.cameras.front().position();
  std::vector<Statistics> pixels(run.width * run.height);
  Statistics all;
  double all_truth = 0;
  EffectResult result;
  std::uint32_t seen = 0;
  for (run.seed = 0; run.seed < kScrambles; ++run.seed) {
    result = run_effect(scene, run);
    double sum = 0;
    seen = 0;
    for (std::uint32_t i = 0; i < pixels.size(); ++i) {
      if (result.ids.values[i * 2] != 1) continue;  // instance 0 is the plane
      pixels[i].add(result.visibility.values[i]);
      sum += result.visibility.values[i];
      ++seen;
    }
    ASSERT_GT(seen, pixels.size() / 4) << "the camera must see the plane";
    all.add(sum / seen);
  }
  // A visible part so small that no ray met it shows no spread; the rule of three bounds it.
  const double unseen = 3.0 / (double(kScrambles) * run.samples);
  double largest = 0;
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    if (result.ids.values[i * 2] != 1) continue;
    const glm::dvec3 place =
        origin + glm::dvec3(result.position.values[i * 4], result.position.values[i * 4 + 1],
                            result.position.values[i * 4 + 2]);
    const double expected = truth(place);
    all_truth += expected / seen;
    const double error = std::abs(pixels[i].mean() - expected);
    largest = std::max(largest, error);
    EXPECT_LE(error, 5 * pixels[i].standard_error() + unseen + kFloatBound)
        << "at x = " << place.x << ", z = " << place.z << ": " << pixels[i].mean() << ", exact "
        << expected;
  }
  std::printf(
      "%u pixels, %u scrambles of %u rays: mean error %.2e (standard error %.2e), largest %.2e\n",
      seen, kScrambles, run.samples, all.mean() - all_truth, all.standard_error(), largest);
  EXPECT_LE(std::abs(all.mean() - all_truth), 5 * all.standard_error() + kFloatBound);
}

TEST(AmbientOcclusionOracle, SphereOverAPlane) {
  EffectRun run;
  run.samples = kRays;
  run.radius = std::numeric_limits<float>::infinity();
  expect_matches(make_sphere_oracle(0.5, 0.8), run, [](const glm::dvec3& p) {
    return 1 - sphere_occlusion(0.5, 0.8, std::hypot(p.x, p.z));
  });
}

TEST(AmbientOcclusionOracle, WallOfOneMetre) {
  EffectRun run;
  run.samples = kRays;
  run.radius = std::numeric_limits<float>::infinity();
  expect_matches(make_wall_oracle(1.0), run,
                 [](const glm::dvec3& p) { return 1 - wall_occlusion(1.0, p.x); });
}

TEST(AmbientOcclusionOracle, HighWallAndRaysOfTwoMetres) {
  EffectRun run;
  run.samples = kRays;
  run.radius = 2.0f;
  expect_matches(make_wall_oracle(10.0), run,
                 [](const glm::dvec3& p) { return 1 - wall_occlusion_bounded(2.0, p.x); });
}

TEST(SunShadowOracle, PenumbraBehindAStraightEdge) {
  EffectRun run;
  run.samples = kRays;
  run.effect = Effect::kSunShadow;
  Scene scene = make_penumbra_oracle(2.0, 0.05);
  scene.cameras.front().vertical_fov = 0.06;  // the penumbra is 20 cm wide
  expect_matches(scene, run,
                 [](const glm::dvec3& p) { return penumbra_visibility(2.0, 0.05, p.x); });
}

}  // namespace
}  // namespace kaamos::test
