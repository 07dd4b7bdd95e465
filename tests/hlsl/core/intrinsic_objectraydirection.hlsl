// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic ObjectRayDirection
// EXPECT f32 0 1 2
// EXPECT f32 4 0
// EXPECT f32 8 0.25 2
// EXPECT f32 12 0
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.xyz = ObjectRayDirection();
}

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(-8, 2, 0), 0, float3(2, 0, 2), 100};  // direction of another length than 1
  store(0, trace(RAY_FLAG_NONE, 0xff, ray));
}
