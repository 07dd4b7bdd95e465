// SPDX-License-Identifier: MIT
// TRAP: 14 payloads of nested traces do not meet
// EXPECT f32 0 5 4
// EXPECT f32 4 8 4
// EXPECT f32 8 1
// EXPECT f32 12 1
// EXPECT u32 16 40
// EXPECT u32 20 3
// EXPECT u32 24 2
// EXPECT u32 28 0
#include "scene.hlsli"

struct Inner {
  float3 a;
  uint b;
};
// Each level has a payload type of its own, which is live while the next trace runs.
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.x = RayTCurrent();
  Inner first = {float3(0, 0, 1), 1};
  Inner second = {float3(0, 0, 1), 2};
  RayDesc ray = {WorldRayOrigin() + 5 * WorldRayDirection(), 0.5, WorldRayDirection(), 50};
  TraceRay(scene, RAY_FLAG_NONE, 255, 1, 0, 0, ray, first);
  TraceRay(scene, RAY_FLAG_NONE, 255, 1, 0, 0, ray, second);
  payload.color.yzw = float3(first.a.x, first.a.z, second.a.z);
  payload.numbers.xyz = uint3(payload.numbers.w + 1, first.b, second.b) + uint3(0, 2, 0);
}
[shader("closesthit")]
void SecondHit(inout Inner inner, BuiltInTriangleIntersectionAttributes attributes) {
  inner.a.x = RayTCurrent();
}

[shader("raygeneration")]
void Main() {
  Payload payload = (Payload)0;
  payload.numbers.w = 39;
  TraceRay(scene, 0, 255, 0, 0, 0, test_ray(0), payload);
  payload.numbers.w = 0;
  store(0, payload);
}
