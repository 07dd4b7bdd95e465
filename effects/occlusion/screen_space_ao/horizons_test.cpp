// SPDX-License-Identifier: MIT
// The integrals of horizons.hlsli, compiled as C++, against quadrature and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/glm.hpp>

#include "effects/assets/built_in/oracle_scenes.h"

namespace horizons {

using float2 = glm::vec2;
using float3 = glm::vec3;
using glm::dot;
using std::acos;
using std::cos;
using std::max;
using std::min;
using std::sin;
using std::sqrt;

#include "effects/occlusion/screen_space_ao/horizons.hlsli"

}  // namespace horizons

namespace kaamos::effects {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Mean over the half circle of slices about the normal of what `of` makes of the elevations of a
// wall's horizon: of height 1, x away.
double mean_over_slices(double x, const std::function<double(double, double)>& of) {
  constexpr int kSlices = 4000;
  double sum = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double c = std::cos(kPi * (i + 0.5) / kSlices);
    const double elevation = std::atan(std::abs(c) / x);
    sum += of(c > 0 ? 0 : elevation, c > 0 ? elevation : 0);
  }
  return sum / kSlices;
}

// E5: the survey's form of the inner integral has lost a sign's brackets and the other horizon.
TEST(Horizons, TheInnerIntegralIsThatOfTheCorrectedForm) {
  double largest = 0;
  for (const double gamma : {-1.2, -0.5, 0.0, 0.3, 1.0}) {
    for (const double h0 : {-1.5, -1.0, -0.4, -0.1}) {
      for (const double h1 : {0.05, 0.5, 1.1, 1.5}) {
        const double low = std::max(h0, gamma - kPi / 2), high = std::min(h1, gamma + kPi / 2);
        double exact = 0;  // of cos(theta - gamma) |sin(theta)| between the horizons
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
          const double theta = low + (high - low) * (i + 0.5) / kSteps;
          exact += std::cos(theta - gamma) * std::abs(std::sin(theta)) * (high - low) / kSteps;
        }
        const float ours = horizons::SliceVisibility(static_cast<float>(h0), static_cast<float>(h1),
                                                     static_cast<float>(gamma));
        EXPECT_NEAR(ours, exact, 2e-6) << gamma << ", " << h0 << ", " << h1;
        const double printed =
            0.25 * ((-std::cos(2 * low) - gamma) + std::cos(gamma) + 2 * high * std::sin(gamma)) +
            0.25 * (-std::cos(2 * high - gamma) + std::cos(gamma) + 2 * high * std::sin(gamma));
        largest = std::max(largest, std::abs(printed - exact));
      }
    }
  }
  EXPECT_GT(largest, 0.3) << "the form as printed is no rounding error away";
}

// GTAO is exact where it knows both horizons; HBAO has no cosine and is darker.
TEST(Horizons, CornersOfBothTechniques) {
  const double hbao[] = {0.578, 0.750, 0.898};
  int i = 0;
  for (const double x : {0.25, 1.0, 3.0}) {
    const double truth = 1 - wall_occlusion(1, x);
    const double gtao = mean_over_slices(x, [](double behind, double before) {
      return horizons::SliceVisibility(static_cast<float>(behind - kPi / 2),
                                       static_cast<float>(kPi / 2 - before), 0.0f);
    });
    const double sines = mean_over_slices(x, [](double behind, double before) {
      return 1 - 0.5 * (std::sin(behind) + std::sin(before));
    });
    EXPECT_NEAR(gtao, truth, 1e-6) << x;
    EXPECT_NEAR(sines, hbao[i++], 5e-4) << x;
    EXPECT_LT(sines, truth - 0.04);
  }
}

TEST(Horizons, BendIsTheIntegralOfDirections) {
  for (const double gamma : {-1.2, -0.5, 0.0, 0.3, 1.0}) {
    for (const double h0 : {-1.5, -0.4}) {
      for (const double h1 : {0.05, 0.5, 1.5}) {
        const double low = std::max(h0, gamma - kPi / 2), high = std::min(h1, gamma + kPi / 2);
        glm::dvec2 exact(0);
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
          const double theta = low + (high - low) * (i + 0.5) / kSteps;
          exact += glm::dvec2(std::sin(theta), std::cos(theta)) *
                   (std::cos(theta - gamma) * std::abs(std::sin(theta)) * (high - low) / kSteps);
        }
        const glm::vec2 ours = horizons::SliceBend(static_cast<float>(h0), static_cast<float>(h1),
                                                   static_cast<float>(gamma));
        EXPECT_NEAR(ours.x, exact.x, 2e-6) << gamma << ", " << h0 << ", " << h1;
        EXPECT_NEAR(ours.y, exact.y, 2e-6) << gamma << ", " << h0 << ", " << h1;
      }
    }
  }
}

// In the corner of two planes half of the hemisphere is open, a quarter of a sphere. The mean of
// its directions, weighted by the cosine to the floor, leans away from the wall by atan(2 / pi).
TEST(Horizons, BentNormalInACornerOfTwoPlanes) {
  constexpr int kSlices = 4000;
  double away = 0, up = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double c = std::cos(kPi * (i + 0.5) / kSlices);  // of the slice towards the wall
    const auto quarter = static_cast<float>(kPi / 2);
    const glm::vec2 bend = c > 0 ? horizons::SliceBend(-quarter, 0.0f, 0.0f)
                                 : horizons::SliceBend(0.0f, quarter, 0.0f);
    away -= c * bend.x;
    up += bend.y;
  }
  EXPECT_NEAR(std::atan2(away, up), std::atan(2 / kPi), 1e-5);
}

// Between two planes that meet at an angle, each point of one sees the same part of the other, so
// that all are equally bright: v + rho (1 - v) v + ... = v / (1 - rho (1 - v)).
TEST(Horizons, BouncesAgainstTheSeriesBetweenTwoPlanes) {
  struct {
    double degrees, allowed;
  } const corners[] = {{60, 0.09}, {90, 0.025}, {120, 0.025}};
  for (const auto& [degrees, allowed] : corners) {
    const double v = 0.5 * (1 - std::cos(degrees * kPi / 180));
    for (const double rho : {0.0, 0.2, 0.5, 0.8}) {
      const double ours = horizons::WithBounces(static_cast<float>(v), static_cast<float>(rho));
      const double series = v / (1 - rho * (1 - v));
      std::printf("%g degrees, albedo %g: %.3f, series %.3f\n", degrees, rho, ours, series);
      EXPECT_NEAR(ours, series, allowed);
      EXPECT_GE(ours, static_cast<float>(v));
    }
    EXPECT_NEAR(horizons::WithBounces(static_cast<float>(v), 0.0f), v, 1e-3) << "black stays";
  }
  EXPECT_NEAR(horizons::WithBounces(1.0f, 0.7f), 1, 1e-3);
  EXPECT_LE(horizons::WithBounces(1.0f, 1.0f), 1);
}

TEST(Horizons, NormalsThatFaceAwayGiveNumbers) {
  for (const glm::vec3 normal : {glm::vec3(0, 0, 1), glm::vec3(1, 0, 1e-4), glm::vec3(0, 1, 0)}) {
    const auto slice = horizons::ProjectNormal(glm::normalize(normal), {1, 0, 0}, {0, 0, -1});
    EXPECT_TRUE(std::isfinite(slice.gamma));
    const float v = horizons::SliceVisibility(-1.0f, 1.0f, slice.gamma);
    EXPECT_TRUE(v >= 0 && v <= 1) << v;
  }
}

}  // namespace
}  // namespace kaamos::effects
