// SPDX-License-Identifier: MIT
// FEATURE: compute groupshared
// EXPECT u32 0 7
// EXPECT u32 4 6
// EXPECT u32 8 5
// EXPECT u32 12 4
// EXPECT u32 16 3
// EXPECT u32 20 2
// EXPECT u32 24 1
// EXPECT u32 28 0
RWByteAddressBuffer results : register(u0);
groupshared uint values[8];

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint index : SV_GroupIndex) {
  values[index] = index;
  GroupMemoryBarrierWithGroupSync();
  results.Store(index * 4, values[7 - index]);
}
