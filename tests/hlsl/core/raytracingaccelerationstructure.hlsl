// SPDX-License-Identifier: MIT
// FEATURE: core RaytracingAccelerationStructure
// EXPECT u32 0 1
// EXPECT u32 4 1
#include "scene.hlsli"

RaytracingAccelerationStructure other : register(t3, space2);
uint shoot(RaytracingAccelerationStructure where) {
  Payload payload = (Payload)0;
  TraceRay(where, 0, 255, 0, 0, 0, test_ray(0), payload);
  return payload.numbers.x;
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x = 1;
}

[shader("raygeneration")]
void Main() {
  RaytracingAccelerationStructure alias = other;
  results.Store2(0, uint2(shoot(scene), shoot(alias)));
}
