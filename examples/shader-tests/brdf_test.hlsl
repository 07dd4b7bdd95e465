// SPDX-License-Identifier: MIT
// What any BRDF keeps: known values at the ends, reciprocity, and no more light out than came in.
#include <kaamos/test.hlsli>

#include "brdf.hlsli"

[test]
void FresnelAtNormalIncidenceIsF0() {
  EXPECT_NEAR(fresnel(float3(0.04, 0.5, 1), 1), float3(0.04, 0.5, 1), 1e-6);
}

[test]
void FresnelAtGrazingIncidenceIsOne() {
  EXPECT_NEAR(fresnel(0.04, 0), 1, 1e-6);
}

float3 direction(float theta, float phi) {
  return float3(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
}

[test]
[cases((0.1, 0.3), (0.5, 0.9), (1.0, 1.5))]
void LightAndViewMayBeExchanged(float alpha, float theta) {
  const float3 n = float3(0, 0, 1);
  const float3 v = direction(0.4, 0.1);
  const float3 l = direction(theta, 2.0);
  const float3 there = specular(n, v, l, 0.04, alpha);
  const float3 back = specular(n, l, v, 0.04, alpha);
  EXPECT_NEAR(there, back, 1e-5 * there.x);
}

// What is reflected under light of 1 from everywhere, at a view of cosine n_dot_v, without Fresnel.
float furnace(float n_dot_v, float alpha) {
  const uint kSteps = 128;
  const float3 v = float3(sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v);
  float sum = 0;
  for (uint i = 0; i < kSteps; ++i) {
    for (uint j = 0; j < kSteps; ++j) {
      const float theta = (i + 0.5) / kSteps * kPi / 2;
      const float3 l = direction(theta, (j + 0.5) / kSteps * 2 * kPi);
      sum += specular(float3(0, 0, 1), v, l, 1, alpha).x * cos(theta) * sin(theta);
    }
  }
  return sum * (kPi / 2 / kSteps) * (2 * kPi / kSteps);
}

[test]
[cases(0.1, 0.3, 0.6, 1.0)]
void GivesBackNoMoreThanItGets(float alpha) {
  const float given = furnace(0.9, alpha);
  printf("alpha %.1f gives back %.3f", alpha, given);
  EXPECT_LE(given, 1.005);
}

// With alpha 1 all directions have as many facets, and the integral can be done by hand:
// the integral of x / (x + v) from 0 to 1.
[test]
[cases(0.2, 0.5, 0.9)]
void RoughestSurfaceGivesBackWhatTheIntegralSays(float n_dot_v) {
  EXPECT_NEAR(furnace(n_dot_v, 1), 1 - n_dot_v * log((1 + n_dot_v) / n_dot_v), 1e-3);
}

[test]
void LightFromBehindIsNotReflected() {
  EXPECT_EQ(specular(float3(0, 0, 1), float3(0, 0, 1), float3(0, 0, -1), 1, 0.5), 0);
}
