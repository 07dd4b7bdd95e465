// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic RayFlags
// EXPECT u32 0 0
// EXPECT u32 4 513
// EXPECT u32 8 33
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x = RayFlags();
}
[shader("miss")]
void MissToo(inout Payload payload) {
  payload.numbers.x = RayFlags();
}

[shader("raygeneration")]
void Main() {
  results.Store(0, trace(RAY_FLAG_NONE, 0xff, test_ray(0)).numbers.x);
  results.Store(4, trace(RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_SKIP_PROCEDURAL_PRIMITIVES, 0xff, test_ray(0)).numbers.x);
  Payload payload = (Payload)0;
  TraceRay(scene, RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_CULL_FRONT_FACING_TRIANGLES, 0xff, 0, 0, 1, test_ray(0), payload);
  results.Store(8, payload.numbers.x);
}
