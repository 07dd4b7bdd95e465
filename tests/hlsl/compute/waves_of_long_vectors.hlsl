// SPDX-License-Identifier: MIT
// FEATURE: compute waves of long vectors
// OPTIONS: -T lib_6_9
// EXPECT u32 0 26 26 26 26
// EXPECT u32 16 6 6 6 6
// EXPECT u32 32 0 5 7 18
// EXPECT u32 48 0 0 1 3
// EXPECT u32 64 3 2 1 0
// EXPECT u32 80 5 5 5 5
// EXPECT u32 96 1 1 1 1
// EXPECT u32 112 0 0 0 0
// EXPECT u32 128 5 2 5 8
// EXPECT u32 144 0 0 5 2
// EXPECT u32 160 1 0 3 2
// EXPECT u32 176 11 11 11 11
RWByteAddressBuffer results : register(u0);

typedef vector<uint, 6> Uints;

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);  // 0, known at run time only
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  Uints a = v;
  a[5] = i;
  const Uints sums = WaveActiveSum(a);
  results.Store(4 * i, sums[4]);
  results.Store(16 + 4 * i, sums[5]);
  const Uints before = WavePrefixSum(a);
  results.Store(32 + 4 * i, before[0]);
  results.Store(48 + 4 * i, before[5]);
  results.Store(64 + 4 * i, WaveReadLaneAt(a, 3 - i)[5]);
  results.Store(80 + 4 * i, WaveReadLaneFirst(a)[3]);
  const vector<bool, 6> equal = WaveActiveAllEqual(Uints(1, 1, 1, 1, z, i));
  results.Store(96 + 4 * i, equal[4]);
  results.Store(112 + 4 * i, equal[5]);
  // Lanes 0 and 2 have the same components, the others have none of their equals.
  results.Store(128 + 4 * i, WaveMatch(Uints(v > 4, 0, 0, 0, 0, i & 1)).x);
  const uint4 mask = uint4((i & 1) ? 10 : 5, 0, 0, 0);
  results.Store(144 + 4 * i, WaveMultiPrefixSum(a, mask)[1]);
  results.Store(160 + 4 * i, QuadReadAcrossX(a)[5]);
  results.Store(176 + 4 * i, WaveActiveMax(a)[2]);
}
