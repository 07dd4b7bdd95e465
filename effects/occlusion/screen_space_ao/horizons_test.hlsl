// SPDX-License-Identifier: MIT
// Visibility between horizons against sums of what it is the integral of.
#include <kaamos/test.hlsli>
#include "horizons.hlsli"

// The weight of an angle in a slice: the cosine to the normal, and how wide the slice is there.
float weight_at(float angle, float gamma) {
  return max(cos(angle - gamma), 0) * abs(sin(angle));
}

// By 4,096 steps between the horizons: the weight, and the weight times the direction.
float3 summed(float h0, float h1, float gamma) {
  const uint steps = 4096;
  float3 sum = 0;
  [loop] for (uint i = 0; i < steps; ++i) {
    const float angle = lerp(h0, h1, (float(i) + 0.5) / steps);
    sum += weight_at(angle, gamma) * float3(1, sin(angle), cos(angle));
  }
  return sum * ((h1 - h0) / steps);
}

[test]
[cases((-1.5, 1.5, 0), (-0.7, 0.2, 0), (-1.2, 0.9, 0.5), (-0.4, 1.4, -0.8), (0, 0, 0.3), (-1.5, 0.1, 1.2))]
void VisibilityIsTheIntegral(float h0, float h1, float gamma) {
  const float low = max(h0, gamma - kHalfPi), high = min(h1, gamma + kHalfPi);
  const float3 expected = summed(low, high, gamma);
  EXPECT_NEAR(SliceVisibility(h0, h1, gamma), expected.x, 1e-5);
  EXPECT_NEAR(SliceBend(h0, h1, gamma), expected.yz, 1e-5);
}

// A half plane that nothing hides counts as 1, if the normal looks at the camera.
[test] void AnOpenSliceIsFull() {
  EXPECT_NEAR(SliceVisibility(-kHalfPi, kHalfPi, 0), 1, 1e-6);
  EXPECT_NEAR(SliceVisibility(0, 0, 0), 0, 1e-6);
}

[test]
[numthreads(64, 1, 1)]
void LoweringAHorizonNeverHides(uint i : SV_GroupIndex) {
  const float gamma = lerp(-1.4, 1.4, float(i) / 63);
  float before = 0;
  [loop] for (uint step = 0; step <= 32; ++step) {
    const float visible = SliceVisibility(0, kHalfPi * float(step) / 32, gamma);
    EXPECT_LE(before, visible + 1e-6);
    before = visible;
  }
}

[test]
[cases((2, 0), (-3, 3.14159265))]
void RoundingMakesNoNan(float x, float expected) {
  EXPECT_NEAR(SafeAcos(x), expected, 1e-6);
}

[test]
[cases((0, 0, 1, 1, 0), (1, 0, 0, 1, 1.5707963), (-0.6, 0, 0.8, 1, -0.6435011), (0.5, 0, -0.5, 0.5, 1.5707963),
       (0, 1, 0, 0, 0))]
void NormalsAreProjected(float x, float y, float z, float expected_length, float gamma) {
  const SliceNormal slice = ProjectNormal(float3(x, y, z), float3(1, 0, 0), float3(0, 0, 1));
  EXPECT_NEAR(slice.length, expected_length, 1e-6);
  EXPECT_NEAR(slice.gamma, gamma, 1e-5);
}

// Light between surfaces only adds, all of it at full visibility, and more of it between brighter ones.
[test]
[numthreads(64, 1, 1)]
void BouncesAddLight(uint i : SV_GroupIndex) {
  const float visibility = float(i) / 63;
  const float3 lit = MultiBounce(visibility, float3(0.1, 0.5, 0.9));
  EXPECT_LE(visibility, lit);
  EXPECT_LE(lit, 1);
  EXPECT_LE(lit.xy, lit.yz + 1e-6);
}
