// SPDX-License-Identifier: MIT
// FEATURE: core SV_RayPayload/SV_IntersectionAttributes semantic
// EXPECT f32 0 0.5 4
// EXPECT f32 4 0
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT u32 16 1
// EXPECT u32 20 0
// EXPECT u32 24 0
// EXPECT u32 28 0
// EXPECT u32 48 0
// EXPECT u32 52 0
// EXPECT u32 56 0
// EXPECT u32 60 99
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload : SV_RayPayload,
         in BuiltInTriangleIntersectionAttributes attributes : SV_IntersectionAttributes) {
  payload.numbers.x = 1;
  payload.color.x = attributes.barycentrics.x;
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 0xff, test_ray(0)));
  store(32, trace(RAY_FLAG_NONE, 0, test_ray(0)));
}
