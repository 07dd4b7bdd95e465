// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveSum
// EXPECT u32 0 26 26 26 26
// EXPECT u32 16 24 102 24 24
// EXPECT i32 32 2 2 2 2
// EXPECT f32 48 1.0 1.0 1.0 1.0
// EXPECT u32 64 26 38 26 38 26 38 26 38
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WaveActiveSum(v));
  if (i != 1) {
    results.Store(16 + 4 * i, WaveActiveSum(v));
  } else {
    results.Store(16 + 4 * i, WaveActiveSum(v + 100));
  }
  results.Store(32 + 4 * i, asuint(WaveActiveSum(int(v) - 6)));
  results.Store(48 + 4 * i, asuint(WaveActiveSum((float(v) - 6) * 0.5)));
  results.Store2(64 + 8 * i, WaveActiveSum(uint2(v, v + 3)));
}
