// SPDX-License-Identifier: MIT
// FEATURE: core closesthit
// EXPECT f32 0 0.5 4
// EXPECT f32 4 0.25 4
// EXPECT f32 8 5 4
// EXPECT f32 12 254
// EXPECT u32 16 1
// EXPECT u32 20 7
// EXPECT u32 24 0
// EXPECT u32 28 1
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color = float4(attributes.barycentrics, RayTCurrent(), HitKind());
  payload.numbers = uint4(PrimitiveIndex(), InstanceID(), InstanceIndex(), GeometryIndex());
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 0xff, test_ray(0)));
}
