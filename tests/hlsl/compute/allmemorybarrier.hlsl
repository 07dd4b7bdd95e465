// SPDX-License-Identifier: MIT
// FEATURE: compute AllMemoryBarrier
// EXPECT u32 0 4
RWByteAddressBuffer results : register(u0);
groupshared uint count;

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint index : SV_GroupIndex) {
  uint before;
  InterlockedAdd(count, 1, before);
  AllMemoryBarrier();
  results.InterlockedAdd(0, 1u);
}
