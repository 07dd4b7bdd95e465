// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic ObjectToWorld4x3
// EXPECT f32 0 2
// EXPECT f32 4 0
// EXPECT f32 8 0
// EXPECT f32 12 2
// EXPECT f32 16 4
// EXPECT f32 20 0
// EXPECT f32 24 0
// EXPECT f32 28 0
// EXPECT f32 32 8
// EXPECT f32 36 1
// EXPECT f32 40 2
// EXPECT f32 44 5
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  const float4x3 m = ObjectToWorld4x3();
  for (uint row = 0; row < 4; ++row) results.Store3(12 * row, asuint(m[row]));
}

[shader("raygeneration")]
void Main() {
  trace(RAY_FLAG_NONE, 0xff, test_ray(0));
}
