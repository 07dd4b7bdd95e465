// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveBitOr
// EXPECT u32 0 31 31 31 31
// EXPECT u32 16 31 118 31 31
// EXPECT u32 32 4294967279 4294967279 4294967279 4294967279
// EXPECT u32 48 31 31 31 31 31 31 31 31
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x181B1215u >> (8 * i) & 255) + z;  // 21, 18, 27, 24
  results.Store(4 * i, WaveActiveBitOr(v));
  if (i != 1) {
    results.Store(16 + 4 * i, WaveActiveBitOr(v));
  } else {
    results.Store(16 + 4 * i, WaveActiveBitOr(v + 100));
  }
  const int negative = -1 - int(v);
  results.Store(32 + 4 * i, WaveActiveBitOr(negative));
  results.Store2(48 + 8 * i, WaveActiveBitOr(uint2(v, v + 3)));
}
