// SPDX-License-Identifier: MIT
//
// Compares the lounge with a committed picture of 32,768 rays per pixel (reference/lounge.exr),
// within the errors that the scrambles of both show. 256 rays in a normal run; 16,384 with
// KAAMOS_FULL=1, with other seeds than the reference's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "effects/assets/built_in/lounge.h"
#include "lounge_reference.h"
#include "size.h"

namespace kaamos::test {
namespace {

using namespace effects;

constexpr std::uint32_t kFullRays = 1024;  // for each of 16 scrambles

// Compares `picture` with the reference where both see the same thing: on another processor a
// pixel's centre on a silhouette may see either side. `deviation`: estimated standard deviation of
// each pixel of `picture`, not including the reference's own error; `step`: the contribution of one
// ray.
void expect_same(const FloatImage& picture, const FloatImage& ids, const FloatImage& deviation,
                 double step, const LoungeReference& reference) {
  const std::size_t pixels = picture.values.size();
  ASSERT_EQ(pixels, reference.mean.values.size());
  std::size_t compared = 0, beyond = 0;
  double sum = 0, sum_of_squares = 0, variance_of_sum = 0, normalised = 0, worst = 0;
  std::size_t worst_pixel = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (ids.values[2 * i] != reference.ids.values[2 * i] ||
        ids.values[2 * i + 1] != reference.ids.values[2 * i + 1]) {
      continue;
    }
    ++compared;
    const double error = picture.values[i] - reference.mean.values[i];
    // Where all scrambles agree, a single ray may still differ now and then.
    const double variance =
        std::pow(deviation.values[i], 2) + std::pow(reference.error.values[i], 2) + step * step;
    sum += error;
    sum_of_squares += error * error;
    variance_of_sum += variance;
    normalised += error * error / variance;
    const double ratio = std::abs(error) / std::sqrt(variance);
    if (ratio > 4) ++beyond;
    if (ratio > worst) {
      worst = ratio;
      worst_pixel = i;
    }
  }
  const double n = static_cast<double>(compared);
  std::printf(
      "%zu of %zu pixels: RMSE %.2e, mean error %.1e (estimated %.1e), error over estimate: RMS "
      "%.2f, largest %.1f at (%zu,%zu), %zu above 4\n",
      compared, pixels, std::sqrt(sum_of_squares / n), sum / n, std::sqrt(variance_of_sum) / n,
      std::sqrt(normalised / n), worst, worst_pixel % kLoungeWidth, worst_pixel / kLoungeWidth,
      beyond);
  EXPECT_GE(compared, pixels * 99 / 100);
  EXPECT_LE(std::abs(sum / n), 5 * std::sqrt(variance_of_sum) / n);
  EXPECT_LE(std::sqrt(normalised / n), 1.3);
  // A deviation estimated from 16 scrambles is itself uncertain: in Student's t distribution with
  // 15 degrees of freedom, 1.2e-3 of the values lie beyond 4 and 1e-6 beyond 8.
  EXPECT_LE(beyond, compared / 200);
  EXPECT_LE(worst, 10);
}

class LoungeReferenceTest : public testing::TestWithParam<Effect> {};

TEST_P(LoungeReferenceTest, IsWithinItsEstimatedError) {
  const Result<LoungeReference> reference = read_lounge_reference(GetParam());
  ASSERT_TRUE(reference.ok()) << reference.error().message;
  const Scene lounge = make_lounge();
  if (is_full_size()) {
    const Estimate estimate =
        estimate_lounge(lounge, GetParam(), kFullRays, kLoungeScrambles, kQuickSeed);
    expect_same(estimate.mean, estimate.ids, estimate.error, 0.5 / (kFullRays * kLoungeScrambles),
                reference.value());
  } else {
    const EffectResult result = run_effect(lounge, lounge_run(GetParam(), kQuickRays, kQuickSeed));
    expect_same(result.visibility, result.ids, reference.value().deviation, 0.5 / kQuickRays,
                reference.value());
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, LoungeReferenceTest,
                         testing::Values(Effect::kAmbientOcclusion, Effect::kSunShadow),
                         [](const auto& tested) {
                           return tested.param == Effect::kAmbientOcclusion ? "AmbientOcclusion"
                                                                            : "SunVisibility";
                         });

}  // namespace
}  // namespace kaamos::test
