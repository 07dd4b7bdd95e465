// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic HitKind
// EXPECT u32 0 254
// EXPECT u32 4 255
// EXPECT u32 8 127
// EXPECT u32 12 1
// EXPECT u32 16 1
#include "scene.hlsli"

struct Attributes {
  float3 normal;
  uint id;
};

[shader("intersection")]
void Box() {
  Attributes attributes = (Attributes)0;
  ReportHit(19, 127, attributes);
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Attributes attributes) {
  payload.numbers.x = HitKind();
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x = HitKind();
}

[shader("raygeneration")]
void Main() {
  results.Store(0, trace(RAY_FLAG_NONE, 0x0f, test_ray(0)).numbers.x);
  RayDesc back = test_ray(6);
  back.Direction = float3(0, 0, -1);
  results.Store(4, trace(RAY_FLAG_NONE, 0x0f, back).numbers.x);
  results.Store(8, trace(RAY_FLAG_NONE, 0xf0, test_ray(0)).numbers.x);
  results.Store2(12, uint2(HIT_KIND_TRIANGLE_FRONT_FACE == 254, HIT_KIND_TRIANGLE_BACK_FACE == 255));
}
