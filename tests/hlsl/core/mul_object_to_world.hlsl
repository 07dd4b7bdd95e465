// SPDX-License-Identifier: MIT
// FEATURE: core 3x4 * : mul(ObjectToWorld3x4(),…)
// EXPECT f32 0 7
// EXPECT f32 4 10
// EXPECT f32 8 29
// EXPECT f32 12 7
// EXPECT f32 16 10
// EXPECT f32 20 29
// EXPECT f32 24 6
// EXPECT f32 28 8
// EXPECT f32 32 24
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  results.Store3(0, asuint(mul(ObjectToWorld3x4(), float4(1, 2, 3, 1))));
  results.Store3(12, asuint(mul(float4(1, 2, 3, 1), ObjectToWorld4x3())));
  results.Store3(24, asuint(mul((float3x3)ObjectToWorld3x4(), float3(1, 2, 3))));
}

[shader("raygeneration")]
void Main() {
  trace(RAY_FLAG_NONE, 0xff, test_ray(0));
}
