// SPDX-License-Identifier: MIT
// FEATURE: compute InterlockedOr
// EXPECT u32 0 15
// EXPECT u32 4 12
// EXPECT u32 8 15
// EXPECT u32 12 12
// EXPECT u32 16 15
// EXPECT u32 20 12
// EXPECT u32 24 12
// EXPECT u32 28 15
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
  InterlockedOr(shared_value, 3, before);
  results.Store2(0, uint2(shared_value, before));
  words[3] = 12;
  InterlockedOr(words[3], 3u, before);
  results.Store2(8, uint2(words[3], before));
  typed[4] = 12;
  InterlockedOr(typed[4], 3u, before);
  results.Store2(16, uint2(typed[4], before));
  results.Store(28, 12);
  results.InterlockedOr(28, 3u, before);
  results.Store(24, before);
}
