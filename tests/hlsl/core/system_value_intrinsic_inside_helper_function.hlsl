// SPDX-License-Identifier: MIT
// FEATURE: core system-value intrinsic inside helper function
// DISPATCH: 3 2 1
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 2
// EXPECT u32 12 3
// EXPECT u32 16 4
// EXPECT u32 20 5
// EXPECT f32 24 5 4
// EXPECT f32 28 5 4
// EXPECT f32 32 5 4
// EXPECT f32 36 5 4
// EXPECT f32 40 5 4
// EXPECT f32 44 5 4
#include "scene.hlsli"

uint linear_index() {
  return DispatchRaysIndex().y * DispatchRaysDimensions().x + DispatchRaysIndex().x;
}
float distance_here() { return RayTCurrent() * length(WorldRayDirection()); }
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  results.Store(24 + 4 * linear_index(), asuint(distance_here()));
}

[shader("raygeneration")]
void Main() {
  results.Store(4 * linear_index(), linear_index() * DispatchRaysDimensions().z);
  trace(RAY_FLAG_NONE, 0xff, test_ray(0));
}
