// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic TraceRay
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 2
// EXPECT u32 12 1
// EXPECT u32 16 0
// EXPECT u32 20 99
// EXPECT u32 24 1
// EXPECT u32 28 99
#include "scene.hlsli"

// The hit group of record 1: see scene.h.
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x = 1;
}
[shader("closesthit")]
void HitToo(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x = 2;
}
uint shoot(uint mask, uint contribution, uint multiplier, float z) {
  Payload payload = (Payload)0;
  TraceRay(scene, 0, mask, contribution, multiplier, 0, test_ray(z), payload);
  return payload.numbers.x + payload.numbers.w;
}

[shader("raygeneration")]
void Main() {
  Payload payloads[2] = (Payload[2])0;
  TraceRay(scene, RAY_FLAG_NONE, 255, 0, 0, 0, test_ray(0), payloads[1]);
  results.Store2(0, uint2(payloads[0].numbers.x, payloads[1].numbers.x));
  results.Store(8, shoot(0xff, 0, 1, 0));        // geometry 1 takes record 1
  results.Store(12, shoot(0xff, 0, 1, -10));     // geometry 0 takes record 0
  results.Store(16, 0);
  results.Store(20, shoot(0xf0, 0, 0, 0));       // no instance has this mask
  results.Store(24, shoot(0x10f, 16, 16, 0));    // only 8, 4 and 4 bits count
  results.Store(28, shoot(0x100, 0, 0, 0));
}
