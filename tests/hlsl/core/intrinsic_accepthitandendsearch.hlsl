// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic AcceptHitAndEndSearch
// EXPECT u32 0 1
// EXPECT u32 4 0
// EXPECT u32 8 1
// EXPECT u32 12 0
#include "scene.hlsli"

[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x += 1;
  AcceptHitAndEndSearch();
  payload.numbers.y += 1;
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.z += 1;
}

[shader("raygeneration")]
void Main() {
  results.Store4(0, trace(RAY_FLAG_NONE, 0xff, test_ray(-10)).numbers);
}
