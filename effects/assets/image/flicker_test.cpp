// SPDX-License-Identifier: MIT
// Pictures that only move have no flicker; noise counts in full.
#include "effects/assets/image/flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 24;

FloatImage ramp(double shift) {
  FloatImage out(kWidth, kHeight, 3);
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        out.at(x, y, c) = static_cast<float>(1.0 + 0.1 * (x + shift) + 0.05 * y * c);
      }
    }
  }
  return out;
}

// All surfaces were `dx` pixels to the right in the previous frame.
FrameSurfaces moved(double dx) {
  FrameSurfaces out = {FloatImage(kWidth, kHeight, 1, 2.0f), FloatImage(kWidth, kHeight, 4)};
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      out.motion.at(x, y, 0) = static_cast<float>(dx / kWidth);
    }
  }
  return out;
}

TEST(Flicker, MotionAloneIsNone) {
  const FloatImage depth(kWidth, kHeight, 1, 2.0f);
  const auto change = temporal_change(ramp(0), ramp(2.25), depth, moved(2.25)).value();
  EXPECT_LT(change.mean(), 1e-6);
  EXPECT_EQ(change.hidden, 3 * kHeight);  // the last columns came from outside the picture
  EXPECT_EQ(change.count, 3 * (kWidth - 3) * kHeight);
  // If it is taken for static, the same pair differs by the motion.
  EXPECT_NEAR(temporal_change(ramp(0), ramp(2.25), depth, moved(0)).value().mean(), 0.225, 1e-5);
}

TEST(Flicker, NoiseIsItsMeanDifference) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(5.0f, 0.1f);
  FloatImage a(kWidth, kHeight, 3), b = a;
  for (float& v : a.values) v = noise(random);
  for (float& v : b.values) v = noise(random);
  const FloatImage depth(kWidth, kHeight, 1, 2.0f);
  const auto change = temporal_change(a, b, depth, moved(0)).value();
  EXPECT_NEAR(change.mean(), 0.1 * 2 / std::sqrt(3.14159265), 0.005);  // E|a - b| of two normals
  EXPECT_NEAR(change.relative(), change.mean() / 5.0, 1e-4);
  TemporalChange sum = change;
  sum.add(change);
  EXPECT_DOUBLE_EQ(sum.mean(), change.mean());
}

TEST(Flicker, HiddenSurfacesAndTheSkyDoNotCount) {
  FloatImage before(kWidth, kHeight, 1, 2.0f);
  FrameSurfaces now = moved(0);
  before.at(5, 5) = 1.0f;      // something was in front of it
  before.at(6, 5) = 0.0f;      // there was no surface
  now.view_z.at(7, 5) = 0.0f;  // now the sky
  now.motion.at(8, 5, 0) = std::numeric_limits<float>::quiet_NaN();
  now.motion.at(9, 5, 2) = std::numeric_limits<float>::quiet_NaN();
  const auto change = temporal_change(ramp(0), ramp(1), before, now).value();
  EXPECT_EQ(change.hidden, 5u);
  EXPECT_EQ(change.count, 3 * (kWidth * kHeight - 5));
}

TEST(Flicker, ValuesThatAreNoNumbersAreCountedApart) {
  FloatImage a = ramp(0);
  a.at(1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
  const FloatImage depth(kWidth, kHeight, 1, 2.0f);
  const auto change = temporal_change(a, ramp(0), depth, moved(0)).value();
  EXPECT_EQ(change.not_finite, 1u);
  EXPECT_EQ(change.mean(), 0.0);
}

TEST(Flicker, SizesMustFit) {
  const FloatImage depth(kWidth, kHeight, 1, 2.0f);
  const auto change = temporal_change(FloatImage(3, 3, 3), ramp(0), depth, moved(0));
  ASSERT_FALSE(change.ok());
  EXPECT_NE(change.error().message.find("then 3x3x3, now 40x24x3"), std::string::npos)
      << change.error().message;
}

}  // namespace
}  // namespace kaamos::effects
