// SPDX-License-Identifier: MIT
// The comparison of two renderers accepts noise and finds what is no noise.
#include "compare_renderers.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace kaamos {
namespace {

using effects::FloatImage;

constexpr std::uint32_t kWidth = 80, kHeight = 40;

FloatImage noisy(float mean, float deviation, unsigned seed) {
  FloatImage out(kWidth, kHeight, 3);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(mean, deviation);
  for (float& value : out.values) value = normal(random);
  return out;
}

TwoHalves halves(float mean, unsigned seed) {
  return {noisy(mean, 0.04f, seed), noisy(mean, 0.04f, seed + 1)};
}

const FloatImage kAll(kWidth, kHeight, 1, 1.0f);

TEST(CompareRenderers, NoiseAloneIsAccepted) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto found =
        compare_renderers(halves(0.5f, 4 * seed), halves(0.5f, 4 * seed + 2), kAll, {});
    ASSERT_TRUE(found.ok());
    EXPECT_TRUE(agrees(found.value(), {})) << seed << ": " << describe(found.value());
    EXPECT_NEAR(found.value().rms / found.value().expected_rms, 1.0, 0.05);
    EXPECT_EQ(found.value().pixels, kWidth * kHeight);
  }
}

TEST(CompareRenderers, OnePercentMoreEverywhereIsFound) {
  const auto found = compare_renderers(halves(0.505f, 1), halves(0.5f, 5), kAll, {});
  ASSERT_TRUE(found.ok());
  EXPECT_FALSE(agrees(found.value(), {})) << describe(found.value());
  EXPECT_NEAR(found.value().bias, 0.005, 4.0 * found.value().bias_error);
}

TEST(CompareRenderers, ATileThatDiffersIsFoundUnlessItIsMasked) {
  TwoHalves first = halves(0.5f, 1);
  FloatImage smooth = kAll;
  for (FloatImage& image : first)
    for (std::uint32_t i = 0; i < 100; ++i)
      for (std::uint32_t c = 0; c < 3; ++c) image.at(20 + i % 10, 10 + i / 10, c) *= 1.3f;
  const auto found = compare_renderers(first, halves(0.5f, 5), smooth, {});
  ASSERT_TRUE(found.ok());
  EXPECT_GT(found.value().worst_tile, 1.0) << describe(found.value());
  EXPECT_EQ(found.value().tile_x, 25u);
  EXPECT_EQ(found.value().tile_y, 15u);
  for (std::uint32_t i = 0; i < 100; ++i) smooth.at(20 + i % 10, 10 + i / 10) = 0.0f;
  EXPECT_TRUE(agrees(compare_renderers(first, halves(0.5f, 5), smooth, {}).value(), {}));
}

TEST(CompareRenderers, EdgesAreNotSmooth) {
  FloatImage ids(5, 5, 2), normal(5, 5, 2);
  for (std::uint32_t y = 0; y < 5; ++y) ids.at(3, y) = ids.at(4, y) = 1.0f;
  const FloatImage smooth = smooth_pixels(ids, normal).value();
  EXPECT_EQ(smooth.at(1, 2), 1.0f);
  EXPECT_EQ(smooth.at(2, 2), 0.0f) << "its neighbour is another instance";
  EXPECT_EQ(smooth.at(0, 2), 0.0f) << "the border has no neighbours";
  normal.at(1, 2) = 0.5f;
  EXPECT_EQ(smooth_pixels(ids, normal).value().at(1, 1), 0.0f);
}

TEST(CompareRenderers, SizesAndValuesAreChecked) {
  EXPECT_FALSE(compare_renderers(halves(1, 1), halves(1, 5), FloatImage(3, 3, 1, 1.0f), {}).ok());
  EXPECT_FALSE(
      compare_renderers(halves(1, 1), halves(1, 5), FloatImage(kWidth, kHeight, 1), {}).ok());
  TwoHalves broken = halves(1, 1);
  broken[1].values[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(compare_renderers(broken, halves(1, 5), kAll, {}).ok());
}

}  // namespace
}  // namespace kaamos
