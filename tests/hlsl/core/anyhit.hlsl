// SPDX-License-Identifier: MIT
// FEATURE: core anyhit
// EXPECT f32 0 23 4
// EXPECT f32 4 0.5 4
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT u32 16 2
// EXPECT u32 20 1
// EXPECT u32 24 0
// EXPECT u32 28 0
#include "scene.hlsli"

// Three candidates; the two nearer ones are ignored, but their writes to the payload stay.
[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  if (GeometryIndex() == 0 || PrimitiveIndex() == 1) {
    payload.numbers.x += 1;
    IgnoreHit();
  }
  payload.numbers.y += 1;
  payload.color.y = attributes.barycentrics.x;
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.x = RayTCurrent();
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 0xff, test_ray(-10)));
}
