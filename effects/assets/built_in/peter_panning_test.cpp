// SPDX-License-Identifier: MIT
// The formulas of the scene against rays through its triangles.
#include "effects/assets/built_in/peter_panning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/assets/common/sampling.h"
#include "effects/assets/common/sobol.h"
#include "effects/assets/scene/host_rays_test_support.h"

namespace kaamos::effects {
namespace {

constexpr double kElevations[] = {0.0524, 0.45, 1.05};

glm::dvec3 to_sun(double elevation) {
  return {std::cos(elevation), std::sin(elevation), 0.0};
}

TEST(PeterPanning, FloorIsLitAsRaysSay) {
  for (const double elevation : kElevations) {
    const PeterPanningDesc desc{.sun_elevation = elevation};
    const HostRays rays(make_peter_panning(desc));
    int of[3] = {0, 0, 0};
    for (std::uint32_t i = 0; i < 1500; ++i) {
      const glm::dvec2 point(-1.5 + 3.0 * unit_float(pcg_hash(2 * i)),
                             -3.1 + 4.7 * unit_float(pcg_hash(2 * i + 1)));
      const FloorLight light = floor_light(desc, point, 1e-3);
      ++of[static_cast<int>(light)];
      if (light == FloorLight::kEdge) continue;
      const bool lit = !rays.nearest({point.x, 0, point.y}, to_sun(elevation)).has_value();
      EXPECT_EQ(lit, light == FloorLight::kLit) << elevation << ": " << point.x << ", " << point.y;
      EXPECT_EQ(lit, sees_sun(desc, point));
    }
    EXPECT_GT(std::min(of[0], of[1]), 50) << elevation;
    EXPECT_LT(of[2], 50) << elevation;
  }
}

// The gap that a bias leaves behind a foot is 0 in truth.
TEST(PeterPanning, ShadowsBeginAtTheLegs) {
  for (const StoolLeg& leg : stool_legs()) {
    for (const double distance : {1e-6, 0.01, 0.25}) {
      EXPECT_FALSE(sees_sun({}, shadow_middle(leg, distance))) << leg.radius << " " << distance;
    }
    // Those away from the sun stand in the shadow of the others.
    EXPECT_EQ(sees_sun({}, leg.at + glm::dvec2(leg.radius + 1e-6, 0.0)), leg.at.x > 0);
  }
}

TEST(PeterPanning, SheetsHideTheSunAsRaysSay) {
  PeterPanningDesc desc{.sun_elevation = 0.6, .angular_radius = 0.05};
  const HostRays rays(make_peter_panning(desc));
  constexpr std::uint32_t kRays = 256;
  for (int part = 0; part < 3; ++part) {
    for (const double x : {-0.7, -0.63, -0.6, -0.585, -0.5}) {
      std::uint32_t open = 0;
      for (std::uint32_t i = 0; i < kRays; ++i) {
        const glm::vec3 way = sample_sun(sobol_owen(i, 1), glm::vec3(to_sun(0.6)), std::tan(0.05f));
        open += !rays.nearest({x, 0, kSheetPartZ[part]}, glm::dvec3(way)).has_value();
      }
      // Three standard errors of 256 such points, which are 0.006 over an edge.
      EXPECT_NEAR(static_cast<double>(open) / kRays, sheet_visibility(desc, part, x), 0.018)
          << part << " " << x;
    }
  }
  // Where both sheets' shadows end the wider penumbra decides.
  EXPECT_DOUBLE_EQ(sheet_visibility(desc, 1, -0.59), sheet_visibility(desc, 0, -0.59));
  EXPECT_DOUBLE_EQ(sheet_visibility(desc, 1, -0.61), sheet_visibility(desc, 2, -0.61));
  EXPECT_NEAR(sheet_visibility(desc, 1, kSheetShadowX), 0.5, 1e-12);
}

}  // namespace
}  // namespace kaamos::effects
