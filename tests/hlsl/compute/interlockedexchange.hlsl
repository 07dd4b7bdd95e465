// SPDX-License-Identifier: MIT
// FEATURE: compute InterlockedExchange
// EXPECT u32 0 5
// EXPECT u32 4 12
// EXPECT u32 8 5
// EXPECT u32 12 12
// EXPECT u32 16 5
// EXPECT u32 20 12
// EXPECT u32 24 12
// EXPECT u32 28 5
groupshared uint shared_value;
groupshared int signed_value;
RWStructuredBuffer<uint> words : register(u1);
RWBuffer<uint> typed : register(u2);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  uint before;
  shared_value = 12;
  InterlockedExchange(shared_value, 5, before);
  results.Store2(0, uint2(shared_value, before));
  words[3] = 12;
  InterlockedExchange(words[3], 5u, before);
  results.Store2(8, uint2(words[3], before));
  typed[4] = 12;
  InterlockedExchange(typed[4], 5u, before);
  results.Store2(16, uint2(typed[4], before));
  results.Store(28, 12);
  results.InterlockedExchange(28, 5u, before);
  results.Store(24, before);
}
