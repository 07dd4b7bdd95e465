// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/packed_cell.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <limits>
#include <random>

namespace kaamos::effects {
namespace {

VolumeCell uniform(float value) {
  VolumeCell cell;
  cell.mean = cell.slope_x = cell.slope_y = cell.slope_z = glm::vec3(value);
  cell.validity = 1;
  return cell;
}

void expect_near(const glm::vec3& got, const glm::vec3& wanted) {
  for (int color = 0; color < 3; ++color) {
    EXPECT_NEAR(got[color], wanted[color], std::abs(wanted[color]) * 0x1p-13f)
        << "colour " << color << ": " << wanted[color];
  }
}

void expect_kept(const VolumeCell& cell) {
  const VolumeCell got = unpack_cell(pack_cell(cell));
  expect_near(got.mean, cell.mean);
  expect_near(got.slope_x, cell.slope_x);
  expect_near(got.slope_y, cell.slope_y);
  expect_near(got.slope_z, cell.slope_z);
  EXPECT_EQ(got.validity, cell.validity);
}

TEST(PackedCell, KeepsEveryValueTo13Bits) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-100, 100), sign(-1, 1);
  const auto value = [&] { return std::exp2(exponent(random)); };
  for (int i = 0; i < 10000; ++i) {
    VolumeCell cell;
    cell.mean = {value(), value(), value()};
    for (glm::vec3* slope : {&cell.slope_x, &cell.slope_y, &cell.slope_z}) {
      for (int color = 0; color < 3; ++color) {
        (*slope)[color] = sign(random) < 0 ? -value() : value();
      }
    }
    cell.validity = i % 2 == 0 ? 1.0f : 0.0f;
    expect_kept(cell);
  }
}

TEST(PackedCell, KeepsBlackAndSingleColours) {
  expect_kept(uniform(0));
  for (int color = 0; color < 3; ++color) {
    VolumeCell cell = uniform(0);
    cell.mean[color] = cell.slope_y[color] = 0.7f;
    expect_kept(cell);
  }
}

// Scaling a volume by a power of two scales its picture by exactly that power.
TEST(PackedCell, RoundsPowersOfTwoAlike) {
  VolumeCell cell = uniform(0.123456f);
  cell.mean = {0.7f, 3.3f, 0.011f};
  const VolumeCell once = unpack_cell(pack_cell(cell));
  for (glm::vec3* part : {&cell.mean, &cell.slope_x, &cell.slope_y, &cell.slope_z}) *part *= 64.0f;
  const VolumeCell brighter = unpack_cell(pack_cell(cell));
  EXPECT_EQ(brighter.mean, 64.0f * once.mean);
  EXPECT_EQ(brighter.slope_x, 64.0f * once.slope_x);
}

TEST(PackedCell, StaysFiniteWhereValuesAreNot) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float value : {FLT_MAX, infinity}) {
    const VolumeCell got = unpack_cell(pack_cell(uniform(value)));
    for (int color = 0; color < 3; ++color) {
      EXPECT_TRUE(std::isfinite(got.mean[color])) << value;
      EXPECT_GT(got.mean[color], 0.999f * FLT_MAX);
    }
  }
  const VolumeCell negative = uniform(-1);
  EXPECT_EQ(unpack_cell(pack_cell(negative)).mean, glm::vec3(0));
  EXPECT_EQ(unpack_cell(pack_cell(negative)).validity, 1.0f);
  VolumeCell none = uniform(1);
  none.slope_x.g = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(unpack_cell(pack_cell(none)).slope_x.g));
}

}  // namespace
}  // namespace kaamos::effects
