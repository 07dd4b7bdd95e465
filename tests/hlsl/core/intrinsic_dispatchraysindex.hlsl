// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic DispatchRaysIndex
// DISPATCH: 2 3 2
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 10
// EXPECT u32 12 11
// EXPECT u32 16 20
// EXPECT u32 20 21
// EXPECT u32 24 100
// EXPECT u32 28 101
// EXPECT u32 32 110
// EXPECT u32 36 111
// EXPECT u32 40 120
// EXPECT u32 44 121
#include "scene.hlsli"

[shader("raygeneration")]
void Main() {
  const uint3 at = DispatchRaysIndex();
  results.Store(4 * (at.x + 2 * (at.y + 3 * at.z)), at.x + 10 * at.y + 100 * at.z);
}
