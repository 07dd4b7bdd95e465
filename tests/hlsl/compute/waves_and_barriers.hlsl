// SPDX-License-Identifier: MIT
// FEATURE: compute waves and barriers
// EXPECT u32 0 2016
// EXPECT u32 4 64
RWByteAddressBuffer results : register(u0);
groupshared uint total;

[shader("compute")]
[numthreads(64, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  if (i == 0) total = 0;
  GroupMemoryBarrierWithGroupSync();
  const uint sum = WaveActiveSum(i) + z;
  if (WaveIsFirstLane()) InterlockedAdd(total, sum);
  GroupMemoryBarrierWithGroupSync();
  if (i == 0) results.Store(0, total);
  GroupMemoryBarrierWithGroupSync();
  if (WaveIsFirstLane()) {
    uint unused;
    InterlockedAdd(total, WaveActiveCountBits(true), unused);
  } else {
    InterlockedAdd(total, 0 * WaveActiveCountBits(true));
  }
  // Each wave's first lane has added 1.
  const uint waves = 64 / min(WaveGetLaneCount(), 64);
  GroupMemoryBarrierWithGroupSync();
  if (i == 0) results.Store(4, total - 2016 - waves + 64);
}
