// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic RayTMin
// EXPECT f32 0 0.5
// EXPECT f32 4 13 4
// EXPECT f32 8 13 4
// EXPECT f32 12 0
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color = float4(RayTMin(), RayTCurrent(), 0, 0);
}

[shader("raygeneration")]
void Main() {
  RayDesc ray = test_ray(0);
  ray.TMin = 0.5;
  results.Store(0, asuint(trace(RAY_FLAG_NONE, 0xff, ray).color.x));
  ray.TMin = 6;  // behind the first triangle
  results.Store(4, asuint(trace(RAY_FLAG_NONE, 0xff, ray).color.y));
  ray.TMax = 13.5;
  results.Store(8, asuint(trace(RAY_FLAG_NONE, 0xff, ray).color.y));
  ray.TMax = 12.5;
  results.Store(12, asuint(trace(RAY_FLAG_NONE, 0xff, ray).color.y));
}
