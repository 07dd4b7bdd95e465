// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveCountBits
// EXPECT u32 0 3 3 3 3
// EXPECT u32 16 1 2 1 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WaveActiveCountBits(v >= 5));
  if (i & 1) {
    results.Store(16 + 4 * i, WaveActiveCountBits(true));
  } else {
    results.Store(16 + 4 * i, WaveActiveCountBits(v == 5));
  }
}
