// SPDX-License-Identifier: MIT
// FEATURE: compute InterlockedCompareExchange
// EXPECT u32 0 64
// EXPECT u32 4 2080
RWByteAddressBuffer results : register(u0);
groupshared uint total;

[shader("compute")]
[numthreads(64, 1, 1)]
void main(uint index : SV_GroupIndex) {
  // Adds index + 1 with compare and exchange.
  uint seen = 0;
  uint found;
  for (uint tries = 0; tries < 1000; ++tries) {
    InterlockedCompareExchange(total, seen, seen + index + 1, found);
    if (found == seen) break;
    seen = found;
  }
  results.InterlockedAdd(0, 1u);
  GroupMemoryBarrierWithGroupSync();
  if (index == 17) results.Store(4, total);
}
