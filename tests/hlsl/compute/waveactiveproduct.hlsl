// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveProduct
// EXPECT u32 0 880 880 880 880
// EXPECT u32 16 440 102 440 440
// EXPECT i32 32 40 40 40 40
// EXPECT f32 48 2.5 2.5 2.5 2.5
// EXPECT u32 64 880 6160 880 6160 880 6160 880 6160
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WaveActiveProduct(v));
  if (i != 1) {
    results.Store(16 + 4 * i, WaveActiveProduct(v));
  } else {
    results.Store(16 + 4 * i, WaveActiveProduct(v + 100));
  }
  results.Store(32 + 4 * i, asuint(WaveActiveProduct(int(v) - 6)));
  results.Store(48 + 4 * i, asuint(WaveActiveProduct((float(v) - 6) * 0.5)));
  results.Store2(64 + 8 * i, WaveActiveProduct(uint2(v, v + 3)));
}
