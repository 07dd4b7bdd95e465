// SPDX-License-Identifier: MIT
// FEATURE: compute GroupMemoryBarrierWithGroupSync
// EXPECT u32 0 28
// EXPECT u32 4 28
// EXPECT u32 8 28
// EXPECT u32 12 28
// EXPECT u32 16 28
// EXPECT u32 20 28
// EXPECT u32 24 28
// EXPECT u32 28 28
// EXPECT u32 32 0
// EXPECT u32 36 7
// EXPECT u32 40 14
// EXPECT u32 44 21
// EXPECT u32 48 28
// EXPECT u32 52 35
// EXPECT u32 56 42
// EXPECT u32 60 49
RWByteAddressBuffer results : register(u0);
groupshared uint shared_values[2][8];
static uint rounds = 0;  // one per thread, kept across barriers

// Every thread sums what all threads wrote, in rounds through helpers that wait.
uint exchange(uint index, uint value, uint bank) {
  shared_values[bank][index] = value;
  GroupMemoryBarrierWithGroupSync();
  rounds += index;
  return shared_values[bank][(index + 1) % 8];
}

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint index : SV_GroupIndex) {
  uint passed[2] = {index, 0};
  for (uint round = 0; round < 8; ++round) {
    passed[1] += passed[0];
    if (round == 7) break;
    passed[0] = exchange(index, passed[0], round & 1);
  }
  results.Store(4 * index, passed[1]);
  results.Store(32 + 4 * index, rounds);
}
