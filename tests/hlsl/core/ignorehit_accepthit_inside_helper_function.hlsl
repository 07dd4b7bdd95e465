// SPDX-License-Identifier: MIT
// FEATURE: core IgnoreHit/AcceptHit inside helper function
// EXPECT f32 0 15 4
// EXPECT u32 4 0
#include "scene.hlsli"

uint decide(inout uint count) {
  count += 1;
  if (GeometryIndex() == 0) IgnoreHit();
  if (PrimitiveIndex() == 1) AcceptHitAndEndSearch();
  IgnoreHit();
  return 7;
}

[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.y = decide(payload.numbers.x) + decide(payload.numbers.x);
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.x = RayTCurrent();
}

[shader("raygeneration")]
void Main() {
  Payload payload = trace(RAY_FLAG_NONE, 0xff, test_ray(-10));
  results.Store(0, asuint(payload.color.x));
  results.Store(4, payload.numbers.y);
}
