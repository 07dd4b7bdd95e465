// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveAnyTrue
// EXPECT u32 0 1 1 1 1
// EXPECT u32 16 0 0 0 0
// EXPECT u32 32 0 1 0 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WaveActiveAnyTrue(v == 11));
  results.Store(16 + 4 * i, WaveActiveAnyTrue(v == 12));
  if (i & 1) {
    results.Store(32 + 4 * i, WaveActiveAnyTrue(v == 8));
  } else {
    results.Store(32 + 4 * i, WaveActiveAnyTrue(v == 8));
  }
}
