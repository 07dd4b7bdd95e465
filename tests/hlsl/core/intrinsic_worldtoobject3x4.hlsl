// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic WorldToObject3x4
// EXPECT f32 0 0.5
// EXPECT f32 4 -0.25
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT f32 16 0
// EXPECT f32 20 0.25
// EXPECT f32 24 0
// EXPECT f32 28 -0.5
// EXPECT f32 32 0
// EXPECT f32 36 0
// EXPECT f32 40 0.125
// EXPECT f32 44 -0.625
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  const float3x4 m = WorldToObject3x4();
  for (uint row = 0; row < 3; ++row) results.Store4(16 * row, asuint(m[row] + 0.0));  // -0 is 0
}

[shader("raygeneration")]
void Main() {
  trace(RAY_FLAG_NONE, 0xff, test_ray(0));
}
