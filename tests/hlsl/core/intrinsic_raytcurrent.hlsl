// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic RayTCurrent
// EXPECT f32 0 5 4
// EXPECT f32 4 100
// EXPECT f32 8 0
// EXPECT f32 12 0
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.x = RayTCurrent();
}

[shader("miss")]
void MissToo(inout Payload payload) {
  payload.color.x = RayTCurrent();  // TMax
}

[shader("raygeneration")]
void Main() {
  results.Store(0, asuint(trace(RAY_FLAG_NONE, 0xff, test_ray(0)).color.x));
  Payload payload = (Payload)0;
  TraceRay(scene, RAY_FLAG_NONE, 0, 0, 0, 1, test_ray(0), payload);
  results.Store(4, asuint(payload.color.x));
}
