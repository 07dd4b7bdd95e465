// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveBitAnd
// EXPECT u32 0 16 16 16 16
// EXPECT u32 16 16 118 16 16
// EXPECT u32 32 4294967264 4294967264 4294967264 4294967264
// EXPECT u32 48 16 16 16 16 16 16 16 16
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x181B1215u >> (8 * i) & 255) + z;  // 21, 18, 27, 24
  results.Store(4 * i, WaveActiveBitAnd(v));
  if (i != 1) {
    results.Store(16 + 4 * i, WaveActiveBitAnd(v));
  } else {
    results.Store(16 + 4 * i, WaveActiveBitAnd(v + 100));
  }
  const int negative = -1 - int(v);
  results.Store(32 + 4 * i, WaveActiveBitAnd(negative));
  results.Store2(48 + 8 * i, WaveActiveBitAnd(uint2(v, v + 3)));
}
