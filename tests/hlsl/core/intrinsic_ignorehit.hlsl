// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic IgnoreHit
// EXPECT u32 0 3
// EXPECT u32 4 0
// EXPECT u32 8 0
// EXPECT u32 12 99
// EXPECT u32 48 0
// EXPECT u32 52 0
// EXPECT u32 56 1
// EXPECT u32 60 0
#include "scene.hlsli"

[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x += 1;
  IgnoreHit();
  payload.numbers.y += 1;
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.z = 1;
}

[shader("raygeneration")]
void Main() {
  results.Store4(0, trace(RAY_FLAG_NONE, 0xff, test_ray(-10)).numbers);
  // Opaque triangles run no any-hit shader.
  store(32, trace(RAY_FLAG_FORCE_OPAQUE, 0xff, test_ray(-10)));
}
