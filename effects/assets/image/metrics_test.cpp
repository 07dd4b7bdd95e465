// SPDX-License-Identifier: MIT
#include "effects/assets/image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "effects/assets/image/flip.h"

namespace kaamos::effects {
namespace {

FloatImage ramp(std::uint32_t width, std::uint32_t height, std::uint32_t channels) {
  FloatImage image(width, height, channels);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    image.values[i] = static_cast<float>(i % 97) / 96.0f;
  }
  return image;
}

TEST(Metrics, AreThoseOfAKnownDifference) {
  FloatImage reference(4, 1, 1, 0.5f), picture(4, 1, 1, 0.5f);
  picture.values[0] = 0.7f;
  picture.values[1] = 0.3f;
  const Metrics m = measure(picture, reference).value();
  EXPECT_NEAR(m.rmse, std::sqrt(2 * 0.04 / 4), 1e-7);
  EXPECT_NEAR(m.relative_mse, 2 * 0.04 / 0.26 / 4, 1e-7);
  EXPECT_NEAR(m.psnr, -10 * std::log10(0.02), 1e-6);
  EXPECT_NEAR(m.bias, 0, 1e-8);
  EXPECT_NEAR(m.energy_ratio, 1, 1e-7);
}

TEST(Metrics, FirefliesAreTrimmed) {
  FloatImage reference(100, 100, 1, 1.0f), picture(100, 100, 1, 1.0f);
  picture.values[77] = 1e4f;
  const Metrics m = measure(picture, reference).value();
  EXPECT_GT(m.relative_mse, 1e3);
  EXPECT_EQ(m.trimmed_relative_mse, 0);
  EXPECT_NEAR(m.energy_ratio, 1.9999, 1e-4);
}

TEST(Metrics, NaNIsCountedAndLeftOut) {
  FloatImage reference(2, 1, 1, 1.0f), picture(2, 1, 1, 1.0f);
  picture.values[0] = std::numeric_limits<float>::quiet_NaN();
  const Metrics m = measure(picture, reference).value();
  EXPECT_EQ(m.not_finite, 1u);
  EXPECT_EQ(m.rmse, 0);
}

TEST(Metrics, TheMaskChooses) {
  FloatImage reference(2, 1, 1, 1.0f), picture(2, 1, 1, 1.0f);
  picture.values[0] = 3.0f;
  const std::uint8_t second[2] = {0, 1};
  EXPECT_EQ(measure(picture, reference, second).value().rmse, 0);
  const std::uint8_t three[3] = {1, 1, 1};
  EXPECT_FALSE(measure(picture, reference, three).ok());
}

TEST(Metrics, DifferentSizesAreAnError) {
  EXPECT_FALSE(measure(FloatImage(2, 1, 1), FloatImage(1, 2, 1)).ok());
  EXPECT_FALSE(ssim(FloatImage(2, 1, 1), FloatImage(1, 2, 1)).ok());
  EXPECT_FALSE(flip(FloatImage(2, 1, 3), FloatImage(2, 1, 1)).ok());
}

TEST(Metrics, BiasAndVarianceComeApart) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0.1f, 0.5f);  // bias 0.1, variance 0.25
  std::vector<FloatImage> pictures;
  for (int i = 0; i < 64; ++i) {
    pictures.emplace_back(40, 40, 1, 0.0f);
    for (float& value : pictures.back().values) value = 1.0f + noise(random);
  }
  const ErrorParts parts = split_error(pictures, FloatImage(40, 40, 1, 1.0f)).value();
  EXPECT_NEAR(parts.bias_squared, 0.01, 0.001);
  EXPECT_NEAR(parts.variance, 0.25, 0.005);
}

TEST(Metrics, FlickerIsTheChangeThatTheReferenceDoesNotHave) {
  const FloatImage black(3, 3, 1, 0.0f), grey(3, 3, 1, 0.5f);
  EXPECT_NEAR(flicker(black, grey, black, black).value(), 0.5, 1e-7);
  EXPECT_NEAR(flicker(black, grey, black, grey).value(), 0, 1e-7);
}

TEST(Ssim, IsOneForEqualPicturesAndKnownForConstants) {
  const FloatImage a = ramp(24, 20, 3);
  EXPECT_NEAR(ssim(a, a).value(), 1, 1e-12);
  // For constants only the luminance term remains.
  const double expected = (2 * 0.2 * 0.6 + 1e-4) / (0.04 + 0.36 + 1e-4);
  EXPECT_NEAR(ssim(FloatImage(16, 16, 1, 0.2f), FloatImage(16, 16, 1, 0.6f)).value(), expected,
              1e-6);
}

TEST(Flip, EqualPicturesDoNotDiffer) {
  const FloatImage a = ramp(24, 20, 3);
  EXPECT_EQ(flip(a, a).value().mean, 0);
}

FloatImage constant(float r, float g, float b) {
  FloatImage image(24, 24, 3);
  for (std::size_t i = 0; i < image.values.size(); i += 3) {
    image.values[i] = r;
    image.values[i + 1] = g;
    image.values[i + 2] = b;
  }
  return image;
}

// Pictures of a single colour have no features, so the map is the redistributed colour distance.
// That of green and blue is the largest there is, 1 by definition.
TEST(Flip, GreenAgainstBlueIsOne) {
  const Flip result = flip(constant(0, 1, 0), constant(0, 0, 1)).value();
  EXPECT_NEAR(result.mean, 1, 1e-6);
}

// Black and white differ by 100 in lightness: 100^0.7 = 25.1189. The largest difference is 41.2760,
// as the paper's reference implementation prints it.
TEST(Flip, BlackAgainstWhiteFollowsFromThePaper) {
  const double knee = 0.4 * 41.2760;
  const double expected = 0.95 + (25.1189 - knee) / (41.2760 - knee) * 0.05;
  EXPECT_NEAR(flip(constant(0, 0, 0), constant(1, 1, 1)).value().mean, expected, 1e-4);
}

TEST(Flip, ChangesAtEdgesCountMoreThanTheSameChangeOfAFlatColour) {
  FloatImage flat = constant(0.5f, 0.5f, 0.5f), edge = flat,
             lighter = constant(0.55f, 0.55f, 0.55f);
  for (std::uint32_t y = 0; y < 24; ++y) {
    for (std::uint32_t x = 12; x < 24; ++x) {
      for (std::uint32_t c = 0; c < 3; ++c) edge.at(x, y, c) = 0.55f;
    }
  }
  const double at_edge = flip(edge, flat).value().map.at(12, 12);
  const double flat_change = flip(lighter, flat).value().map.at(12, 12);
  EXPECT_GT(at_edge, flat_change);
}

TEST(Flip, ValuesOutOfRangeAreClamped) {
  FloatImage wild = constant(1, 1, 1);
  wild.values[0] = 1e30f;
  wild.values[4] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(flip(wild, constant(1, 1, 1)).value().mean, 0);
  wild.values[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isfinite(flip(wild, constant(1, 1, 1)).value().mean));
}

}  // namespace
}  // namespace kaamos::effects
