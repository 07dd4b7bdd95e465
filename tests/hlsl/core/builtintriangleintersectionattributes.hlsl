// SPDX-License-Identifier: MIT
// FEATURE: core BuiltInTriangleIntersectionAttributes
// EXPECT f32 0 0.25 8
// EXPECT f32 4 0.5 4
// EXPECT f32 8 0.25 4
// EXPECT f32 12 0
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.xyz = float3(1 - attributes.barycentrics.x - attributes.barycentrics.y,
                             attributes.barycentrics);
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 0xff, test_ray(0)));
}
