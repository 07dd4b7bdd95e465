// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic DispatchRaysDimensions
// DISPATCH: 2 3 4
// EXPECT u32 0 2
// EXPECT u32 4 3
// EXPECT u32 8 4
#include "scene.hlsli"

[shader("raygeneration")]
void Main() {
  results.Store3(0, DispatchRaysDimensions());
}
