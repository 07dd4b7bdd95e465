// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveBitXor
// EXPECT u32 0 4 4 4 4
// EXPECT u32 16 22 118 22 22
// EXPECT u32 32 4 4 4 4
// EXPECT u32 48 4 8 4 8 4 8 4 8
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x181B1215u >> (8 * i) & 255) + z;  // 21, 18, 27, 24
  results.Store(4 * i, WaveActiveBitXor(v));
  if (i != 1) {
    results.Store(16 + 4 * i, WaveActiveBitXor(v));
  } else {
    results.Store(16 + 4 * i, WaveActiveBitXor(v + 100));
  }
  const int negative = -1 - int(v);
  results.Store(32 + 4 * i, WaveActiveBitXor(negative));
  results.Store2(48 + 8 * i, WaveActiveBitXor(uint2(v, v + 3)));
}
