// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveMax
// EXPECT u32 0 11 11 11 11
// EXPECT u32 16 11 102 11 11
// EXPECT i32 32 5 5 5 5
// EXPECT f32 48 2.5 2.5 2.5 2.5
// EXPECT u32 64 11 14 11 14 11 14 11 14
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WaveActiveMax(v));
  if (i != 1) {
    results.Store(16 + 4 * i, WaveActiveMax(v));
  } else {
    results.Store(16 + 4 * i, WaveActiveMax(v + 100));
  }
  results.Store(32 + 4 * i, asuint(WaveActiveMax(int(v) - 6)));
  results.Store(48 + 4 * i, asuint(WaveActiveMax((float(v) - 6) * 0.5)));
  results.Store2(64 + 8 * i, WaveActiveMax(uint2(v, v + 3)));
}
