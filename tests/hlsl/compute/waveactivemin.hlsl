// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveMin
// EXPECT u32 0 2 2 2 2
// EXPECT u32 16 5 102 5 5
// EXPECT i32 32 -4 -4 -4 -4
// EXPECT f32 48 -2.0 -2.0 -2.0 -2.0
// EXPECT u32 64 2 5 2 5 2 5 2 5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WaveActiveMin(v));
  if (i != 1) {
    results.Store(16 + 4 * i, WaveActiveMin(v));
  } else {
    results.Store(16 + 4 * i, WaveActiveMin(v + 100));
  }
  results.Store(32 + 4 * i, asuint(WaveActiveMin(int(v) - 6)));
  results.Store(48 + 4 * i, asuint(WaveActiveMin((float(v) - 6) * 0.5)));
  results.Store2(64 + 8 * i, WaveActiveMin(uint2(v, v + 3)));
}
