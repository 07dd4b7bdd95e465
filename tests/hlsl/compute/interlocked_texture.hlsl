// SPDX-License-Identifier: MIT
// FEATURE: compute InterlockedAdd
// EXPECT u32 0 43
// EXPECT u32 4 48
// EXPECT u32 8 5
// EXPECT u32 12 7
// EXPECT u32 16 7
// EXPECT u32 20 5
// EXPECT u32 24 9
RWTexture2D<uint> counters_uint : register(u1);
RWBuffer<uint> typed : register(u2);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint before;
  InterlockedAdd(counters_uint[uint2(3, 4)], 5u, before);
  results.Store2(0, uint2(before, counters_uint[uint2(3, 4)]));
  counters_uint[uint2(1, 0)] = 5;
  InterlockedExchange(counters_uint[uint2(1, 0)], 7u, before);
  results.Store3(8, uint3(before, counters_uint[uint2(1, 0)], counters_uint[uint2(7, 0)]));
  InterlockedMax(typed[5], 9u, before);
  InterlockedAdd(typed[100000], 9u);  // out of bounds: dropped
  results.Store2(20, uint2(before, typed[5]));
}
