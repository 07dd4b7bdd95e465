// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic ObjectRayOrigin
// EXPECT f32 0 -4.5 2
// EXPECT f32 4 0
// EXPECT f32 8 -0.625 2
// EXPECT f32 12 -2 4
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.xyz = ObjectRayOrigin();
  payload.color.w = (ObjectRayOrigin() + RayTCurrent() * ObjectRayDirection()).x;
}

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(-8, 2, 0), 0, float3(2, 0, 2), 100};  // direction of another length than 1
  store(0, trace(RAY_FLAG_NONE, 0xff, ray));
}
