// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveAllEqual
// EXPECT u32 0 0 0 0 0
// EXPECT u32 16 1 1 1 1
// EXPECT u32 32 0 1 0 1 0 1 0 1
// EXPECT u32 64 1 1 1 1
// EXPECT u32 80 0 0 0 0
// EXPECT u32 96 1 1 1 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WaveActiveAllEqual(v));
  results.Store(16 + 4 * i, WaveActiveAllEqual(v * 0));
  const bool2 parts = WaveActiveAllEqual(float2(v, 3.5 + z));
  results.Store2(32 + 8 * i, uint2(parts));
  if (i == 2) {
    results.Store(64 + 4 * i, WaveActiveAllEqual(v));
  } else {
    results.Store(64 + 4 * i, WaveActiveAllEqual(v > 11));
  }
  // A NaN equals nothing; both zeros are equal.
  results.Store(80 + 4 * i, WaveActiveAllEqual(asfloat(0x7FC00000u + z)));
  results.Store(96 + 4 * i, WaveActiveAllEqual(asfloat((i << 31) + z)));
}
