// SPDX-License-Identifier: MIT
// TRAP: 20 system values in helpers
// DISPATCH: 3 1 1
// EXPECT u32 0 1
// EXPECT u32 4 2
// EXPECT u32 8 3
// EXPECT u32 12 101
// EXPECT u32 16 101
// EXPECT u32 20 101
// EXPECT u32 24 3
// EXPECT u32 28 3
// EXPECT u32 32 3
#include "scene.hlsli"

// Static globals are initialised again for each shader invocation.
static uint counter = 1;
static const uint kStep = 100;
uint count() { return counter++; }
uint here() { return DispatchRaysIndex().x; }
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x = kStep + count();
  count();
}

[shader("raygeneration")]
void Main() {
  results.Store(4 * here(), count() + here());
  count();
  results.Store(12 + 4 * here(), trace(RAY_FLAG_NONE, 0xff, test_ray(0)).numbers.x);
  results.Store(24 + 4 * here(), count());
}
