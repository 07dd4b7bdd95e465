// SPDX-License-Identifier: MIT
// FEATURE: compute InterlockedCompareExchange
// EXPECT u32 0 8
// EXPECT u32 4 5
// EXPECT u32 8 8
// EXPECT u32 12 8
// EXPECT u32 16 3
// EXPECT u32 20 7
groupshared uint value;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  uint before;
  value = 5;
  InterlockedCompareExchange(value, 5, 8, before);
  results.Store2(0, uint2(value, before));
  InterlockedCompareExchange(value, 5, 9, before);
  results.Store2(8, uint2(value, before));
  InterlockedCompareStore(value, 8, 3);
  results.Store(16, value);
  results.Store(20, 1);
  results.InterlockedCompareExchange(20, 1, 2, before);
  results.InterlockedCompareStore(20, 2, 7);
}
