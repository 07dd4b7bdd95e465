// SPDX-License-Identifier: MIT
#include "effects/assets/common/specular_albedo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/assets/common/albedo_integral.h"

namespace kaamos::effects {
namespace {

constexpr double kPi = 3.14159265358979;

double white(double alpha, double cosine) {
  const glm::dvec2 split = integrate_specular_albedo(cosine, std::sqrt(alpha));
  return split.x + split.y;
}

// A white furnace, F = 1: from quadrature, and from the closed form for alpha 1 seen head-on.
TEST(SpecularAlbedo, HasTheKnownValues) {
  const auto degrees = [](double angle) { return std::cos(angle * kPi / 180); };
  EXPECT_NEAR(white(0.1, degrees(80)), 0.8955, 0.001);
  EXPECT_NEAR(white(0.5, 1), 0.6878, 0.0002);
  EXPECT_NEAR(white(0.5, degrees(30)), 0.6831, 0.0002);
  EXPECT_NEAR(white(1, degrees(85)), 0.7801, 0.0002);
  EXPECT_NEAR(white(1, 1), 1 - std::log(2.0), 0.0002);
}

// The integral over light directions, by the midpoint rule: nothing of the host's routine is used.
glm::dvec2 by_light_directions(double cosine, double roughness) {
  constexpr int kHeights = 2000, kAngles = 500;
  const double a2 = std::pow(roughness, 4);
  const glm::dvec3 view(std::sqrt(1 - cosine * cosine), 0, cosine);
  const auto lambda = [&](double c) {
    return 0.5 * (std::sqrt(1 + a2 * (1 - c * c) / (c * c)) - 1);
  };
  glm::dvec2 sum(0.0);
  for (int i = 0; i < kHeights; ++i) {
    const double z = (i + 0.5) / kHeights, s = std::sqrt(1 - z * z);
    for (int k = 0; k < kAngles; ++k) {
      const double phi = kPi * (k + 0.5) / kAngles;
      const glm::dvec3 light(s * std::cos(phi), s * std::sin(phi), z);
      const glm::dvec3 half = glm::normalize(view + light);
      const double d = half.z * half.z * (a2 - 1) + 1;
      const double density = a2 / (kPi * d * d);
      const double specular =
          density / (1 + lambda(cosine) + lambda(z)) / (4 * cosine * z) * z * 2 * kPi;
      const double fresnel = std::pow(1 - glm::dot(view, half), 5);
      sum += specular * glm::dvec2(1 - fresnel, fresnel) / double(kHeights * kAngles);
    }
  }
  return sum;
}

TEST(SpecularAlbedo, IsTheIntegralOverLight) {
  for (const double roughness : {0.45, 0.7, 0.95}) {
    for (const double cosine : {0.07, 0.3, 0.65, 0.98}) {
      const glm::dvec2 wanted = by_light_directions(cosine, roughness);
      const glm::dvec2 split = integrate_specular_albedo(cosine, roughness);
      EXPECT_NEAR(split.x, wanted.x, 0.001) << roughness << ", " << cosine;
      EXPECT_NEAR(split.y, wanted.y, 0.001) << roughness << ", " << cosine;
      // Between the corners of the table.
      const glm::vec3 read =
          specular_albedo({0, 0.04f, 1}, static_cast<float>(roughness), static_cast<float>(cosine));
      EXPECT_NEAR(read.x, wanted.y, 0.002) << roughness << ", " << cosine;
      EXPECT_NEAR(read.y, 0.04 * wanted.x + wanted.y, 0.002) << roughness << ", " << cosine;
      EXPECT_NEAR(read.z, wanted.x + wanted.y, 0.003) << roughness << ", " << cosine;
    }
  }
}

TEST(SpecularAlbedo, IsFresnelsTermOnAMirrorAndNeverAboveOne) {
  for (int i = 0; i <= 100; ++i) {
    const float cosine = static_cast<float>(i) / 100;
    EXPECT_NEAR(specular_albedo(glm::vec3(0.04f), 0, cosine).x,
                0.04 + 0.96 * std::pow(1 - cosine, 5), 0.004);
    for (int k = 0; k <= 20; ++k) {
      EXPECT_LE(specular_albedo(glm::vec3(1), static_cast<float>(k) / 20, cosine).x, 1.000001f);
    }
  }
}

}  // namespace
}  // namespace kaamos::effects
