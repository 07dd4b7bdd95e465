// SPDX-License-Identifier: MIT
// FEATURE: compute GroupMemoryBarrierWithGroupSync
// EXPECT u32 0 120
RWByteAddressBuffer results : register(u0);
groupshared uint sums[16];

[shader("compute")]
[numthreads(16, 1, 1)]
void main(uint index : SV_GroupIndex) {
  sums[index] = index;
  for (uint step = 8; step > 0; step /= 2) {
    GroupMemoryBarrierWithGroupSync();
    if (index < step) {
      sums[index] += sums[index + step];
    }
  }
  GroupMemoryBarrierWithGroupSync();
  if (index == 0) {
    results.Store(0, sums[0]);
  }
}
