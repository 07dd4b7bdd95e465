// SPDX-License-Identifier: MIT
#include "effects/assets/image/edge_band.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace kaamos::effects {
namespace {

TEST(EdgeBand, ReachesToBothSidesOfAStep) {
  FloatImage view_z(12, 4, 1, 2.0f);
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 6; x < 12; ++x) view_z.at(x, y) = 3.0f;
  }
  const std::vector<bool> band = edge_band(view_z, 3);
  for (std::uint32_t i = 0; i < 48; ++i) EXPECT_EQ(band[i], i % 12 >= 3 && i % 12 < 9) << i;
}

TEST(EdgeBand, ThinThingsAndTheSkyHaveEdges) {
  FloatImage view_z(9, 1, 1, 4.0f);
  view_z.at(4, 0) = 1.0f;
  EXPECT_EQ(std::ranges::count(edge_band(view_z, 1), true), 3);
  view_z.at(4, 0) = 0.0f;
  EXPECT_EQ(std::ranges::count(edge_band(view_z, 1), true), 3);
  EXPECT_EQ(std::ranges::count(edge_band(FloatImage(9, 1, 1, 0.0f), 3), true), 0);
}

TEST(EdgeBand, ASlantedPlaneHasNone) {
  FloatImage view_z(16, 16, 1);
  for (std::uint32_t y = 0; y < 16; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      // A floor to the horizon, nearly ten times as far away at the top.
      view_z.at(x, y) =
          1.0f / (0.06f + 0.03f * static_cast<float>(y) + 0.01f * static_cast<float>(x));
    }
  }
  EXPECT_EQ(std::ranges::count(edge_band(view_z, 3), true), 0);
}

}  // namespace
}  // namespace kaamos::effects
