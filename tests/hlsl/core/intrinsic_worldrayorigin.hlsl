// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic WorldRayOrigin
// EXPECT f32 0 -8
// EXPECT f32 4 2
// EXPECT f32 8 0
// EXPECT f32 12 2.5 4
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color = float4(WorldRayOrigin(), RayTCurrent());
}

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(-8, 2, 0), 0, float3(2, 0, 2), 100};  // direction of another length than 1
  store(0, trace(RAY_FLAG_NONE, 0xff, ray));
}
