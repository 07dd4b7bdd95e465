// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic InstanceID
// EXPECT u32 0 7
// EXPECT u32 4 9
// EXPECT u32 8 7
// EXPECT u32 12 9
#include "scene.hlsli"

struct Attributes {
  float3 normal;
  uint id;
};

[shader("intersection")]
void Box() {
  Attributes attributes = (Attributes)0;
  ReportHit(19, 0, attributes);
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Attributes attributes) {
  payload.numbers.x = InstanceID();
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x = InstanceID();
}

[shader("raygeneration")]
void Main() {
  results.Store(0, trace(RAY_FLAG_NONE, 0x0f, test_ray(0)).numbers.x);
  results.Store(4, trace(RAY_FLAG_NONE, 0xf0, test_ray(0)).numbers.x);
  results.Store(8, trace(RAY_FLAG_NONE, 0x0f, test_ray(-10)).numbers.x);
  results.Store(12, trace(RAY_FLAG_SKIP_TRIANGLES, 0xff, test_ray(-10)).numbers.x);
}
