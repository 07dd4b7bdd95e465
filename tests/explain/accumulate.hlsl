// SPDX-License-Identifier: MIT
// Adds to the contents of textures.

RWTexture2D<float> total : register(u0);
RWTexture2D<float4> totals[2] : register(u1);

[shader("raygeneration")]
void Accumulate() {
  const uint2 at = DispatchRaysIndex().xy;
  total[at] += 1.0;
  totals[at.x & 1][at] += float4(1, 2, 3, 4);
}
