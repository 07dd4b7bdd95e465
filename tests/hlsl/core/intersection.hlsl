// SPDX-License-Identifier: MIT
// FEATURE: core intersection
// EXPECT f32 0 19 2
// EXPECT f32 4 0.25
// EXPECT f32 8 -1
// EXPECT f32 12 3
// EXPECT u32 16 1
// EXPECT u32 20 9
// EXPECT u32 24 1
// EXPECT u32 28 5
#include "scene.hlsli"

struct Attributes {
  float3 normal;
  uint id;
};

[shader("intersection")]
void Box() {
  Attributes attributes;
  attributes.normal = float3(0.25, 0.5, -1);
  attributes.id = 5;
  // The front side of the box in object space.
  ReportHit((-1 - ObjectRayOrigin().z) / ObjectRayDirection().z, 3, attributes);
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Attributes attributes) {
  payload.color = float4(RayTCurrent(), attributes.normal.x, attributes.normal.z, HitKind());
  payload.numbers = uint4(PrimitiveIndex(), InstanceID(), InstanceIndex(), attributes.id);
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 0xf0, test_ray(0)));
}
