// SPDX-License-Identifier: MIT
// FEATURE: core TraceRay from closesthit/miss (recursion)
// EXPECT f32 0 5 4
// EXPECT f32 4 13 4
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT u32 16 2
// EXPECT u32 20 20
// EXPECT u32 24 0
// EXPECT u32 28 0
#include "scene.hlsli"

// From the first triangle to the second, and from there to a miss.
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  Payload next = payload;
  next.numbers.x += 1;
  RayDesc ray = {WorldRayOrigin() + WorldRayDirection() * RayTCurrent(), 0.001, WorldRayDirection(), 50};
  const float here = ray.Origin.z;
  TraceRay(scene, RAY_FLAG_NONE, 255, 0, 0, 1, ray, next);
  payload.numbers = next.numbers;
  payload.color = float4(here, next.color.x, next.color.y, 0);
}
[shader("miss")]
void MissToo(inout Payload payload) {
  if (payload.numbers.y == 0) {
    payload.numbers.y = 10;
    TraceRay(scene, RAY_FLAG_NONE, 0, 0, 0, 1, test_ray(0), payload);
  }
  payload.numbers.y += 5;
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 255, test_ray(0)));
}
