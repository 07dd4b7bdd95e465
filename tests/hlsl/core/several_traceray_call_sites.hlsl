// SPDX-License-Identifier: MIT
// FEATURE: core >1 TraceRay call sites
// EXPECT u32 0 1
// EXPECT u32 4 0
// EXPECT u32 8 0
// EXPECT u32 12 99
// EXPECT u32 16 1
// EXPECT u32 20 0
// EXPECT u32 24 0
// EXPECT u32 28 0
// EXPECT u32 32 4
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x += 1;
}

[shader("raygeneration")]
void Main() {
  Payload payload = (Payload)0;
  TraceRay(scene, RAY_FLAG_NONE, 255, 0, 0, 0, test_ray(0), payload);
  TraceRay(scene, RAY_FLAG_NONE, 255, 0, 0, 0, test_ray(14), payload);
  results.Store4(0, payload.numbers);
  payload = (Payload)0;
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH, 255, 0, 0, 0, test_ray(0), payload);
  results.Store4(16, payload.numbers);
  for (uint i = 0; i < 3; ++i) {
    TraceRay(scene, RAY_FLAG_NONE, 255, 0, 0, 0, test_ray(i), payload);
  }
  results.Store(32, payload.numbers.x);
}
