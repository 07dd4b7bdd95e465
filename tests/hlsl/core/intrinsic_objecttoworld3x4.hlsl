// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic ObjectToWorld3x4
// EXPECT f32 0 2
// EXPECT f32 4 2
// EXPECT f32 8 0
// EXPECT f32 12 1
// EXPECT f32 16 0
// EXPECT f32 20 4
// EXPECT f32 24 0
// EXPECT f32 28 2
// EXPECT f32 32 0
// EXPECT f32 36 0
// EXPECT f32 40 8
// EXPECT f32 44 5
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  const float3x4 m = ObjectToWorld3x4();
  for (uint row = 0; row < 3; ++row) results.Store4(16 * row, asuint(m[row]));
}

[shader("raygeneration")]
void Main() {
  trace(RAY_FLAG_NONE, 0xff, test_ray(0));
}
