// SPDX-License-Identifier: MIT
// TRAP: 15 IgnoreHit ends the shader from any depth
// EXPECT f32 0 23 4
// EXPECT f32 4 6
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT u32 16 2
// EXPECT u32 20 3
// EXPECT u32 24 0
// EXPECT u32 28 0
#include "scene.hlsli"

// inner() accepts the far triangle and ends the shader for the two in front of it. What was written
// to the payload before that stays.
bool inner(inout Payload payload, bool far) {
  if (!far) {
    payload.numbers.x += 1;
    IgnoreHit();
  }
  return true;
}
uint outer(inout Payload payload) {
  return inner(payload, GeometryIndex() == 1 && PrimitiveIndex() == 0) ? 3 : 20;
}
[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.y += outer(payload) + outer(payload);
  payload.numbers.y += 3;
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.x = RayTCurrent();
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 0xff, test_ray(-10)));
}
