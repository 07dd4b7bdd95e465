// SPDX-License-Identifier: MIT
// FEATURE: core >1 payload struct types in one library
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 5
#include "scene.hlsli"

struct Shadow {
  bool visible;
};
[shader("miss")]
void ShadowMiss(inout Shadow payload) {
  payload.visible = true;
}
[shader("closesthit")]
void ShadowHit(inout Shadow payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.visible = false;
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x = 5;
}
bool visible(uint mask) {
  Shadow shadow = {mask != 0};
  TraceRay(scene, RAY_FLAG_NONE, mask, 1, 0, 1, test_ray(0), shadow);
  return shadow.visible;
}

[shader("raygeneration")]
void Main() {
  results.Store2(0, uint2(visible(0xff), visible(0)));
  results.Store(8, trace(RAY_FLAG_NONE, 0xff, test_ray(0)).numbers.x);
}
